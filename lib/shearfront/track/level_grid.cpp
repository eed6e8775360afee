// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/level_grid.hpp"

#include <boost/sort/pdqsort/pdqsort.hpp>
#include <concepts>
#include <optional>
#include <variant>

#include "shearfront/numeric/instantiated.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront {

namespace {

/// How many steps of at most `step` make up `length`; a double, because it may be larger than any integer
/// type.
template <Real S>
double whole_steps(const S& length, const S& step) {
  // A quotient that is whole up to rounding must not become one step more.
  return std::max(1.0, std::ceil(to_double(S(length / step)) * (1 - 1e-12)));
}

}  // namespace

/// Levels on their way into a grid.
template <Real S>
struct LevelGrid<S>::Draft {
  /// A wanted state as a level.
  struct Extra {
    Level level;
    std::size_t wanted;
  };
  /// The order of levels: by the flux of the data they come from, of which `value` is the rounded number. Two
  /// states one rounding apart would otherwise change places, or be taken for one.
  struct Order {
    const std::vector<Class>& classes;
    bool rounded = false;  ///< by the rounded number after all: where there are levels on chords

    bool operator()(const Level& a, const Level& b) const {
      if (rounded) {
        if (a.value != b.value) return a.value < b.value;
        return a.home != b.home ? a.home < b.home : a.p < b.p;
      }
      if (a.home == b.home) return a.p < b.p;
      constexpr int kRoundings = 8;  // a value carries fewer
      const S gap = a.value < b.value ? b.value - a.value : a.value - b.value;
      if (gap > S(kRoundings) * unit_roundoff<S>() * (a.value + b.value)) return a.value < b.value;
      const TwoSum<S> x = unrounded(a), y = unrounded(b);
      if (x.high != y.high) return x.high < y.high;
      if (x.low != y.low) return x.low < y.low;
      if (a.home != b.home) return a.home < b.home;
      return a.p < b.p;
    }
    [[nodiscard]] bool is_same(const Level& a, const Level& b) const {
      return !(*this)(a, b) && !(*this)(b, a);
    }
    void sort(std::vector<Extra>& extras) const {
      std::sort(extras.begin(), extras.end(),
                [this](const Extra& a, const Extra& b) { return (*this)(a.level, b.level); });
    }
    /// 4 c p (1 - p) in twice the digits.
    [[nodiscard]] TwoSum<S> unrounded(const Level& level) const {
      const S& c = classes[static_cast<std::size_t>(level.home)].capacity;
      const TwoSum<S> rest(S(1), S(-level.p));
      const TwoProduct<S> x(S(4) * c, level.p), y(x.high, rest.high);
      return {y.high, y.low + (x.low * rest.high + x.high * rest.low)};
    }
  };

  /// phi of a wanted state on the falling branch; exact, because 1 - phi is for phi >= 1/2.
  static S falling(const S& phi) { return phi + phi <= S(1) ? phi : S(1) - phi; }

  /// The vertices: every capacity and, below each, equal steps of phi in its own layers. Between two
  /// neighbouring capacities the spacing of phi is widest in the layer of the upper one, because
  /// d(phi)/dh = 1 / (4 sqrt(c (c - h))) falls with c; so these are the fewest levels that keep every layer
  /// within the resolution.
  static Levels vertices(const std::vector<Class>& classes, const S& resolution) {
    using std::sqrt;
    Levels levels;
    levels.reserve(static_cast<std::size_t>(level_count(classes, resolution)));
    levels.push_back({S(0), S(0), 0, 0, 0, 0});
    S previous(0);
    for (std::size_t c = 0; c < classes.size(); ++c) {
      const auto home = static_cast<std::int32_t>(c);
      const S& capacity = classes[c].capacity;
      const S q_first = sqrt((capacity - previous) / capacity);
      const S p_first = previous / (S(2) * capacity * (S(1) + q_first));
      const auto n = static_cast<std::uint64_t>(whole_steps(S(q_first / S(2)), resolution));
      const S n_steps(static_cast<double>(n)), p_range = q_first / S(2);
      for (std::uint64_t i = 1; i < n; ++i) {
        const S p = p_first + p_range * (S(static_cast<double>(i)) / n_steps);
        const S value = capacity * (S(4) * (p * (S(1) - p)));
        if (value > levels.back().value && value < capacity) levels.push_back({value, p, home, 0, 0, 0});
      }
      levels.push_back({capacity, S(1) / S(2), home, 0, 0, 0});
      previous = capacity;
    }
    return levels;
  }
  static double level_count(const std::vector<Class>& classes, const S& resolution) {
    using std::sqrt;
    double count = 1;
    S previous(0);
    for (const Class& c : classes) {
      count += whole_steps(S(sqrt((c.capacity - previous) / c.capacity) / S(2)), resolution);
      previous = c.capacity;
    }
    return count;
  }

  /// Raises values by rounding errors so that they ascend with p among the levels of one home: next to 1/2
  /// values differ by less than a unit in the last place, and may come out in the wrong order.
  static void make_monotone(Levels& vertices, std::vector<Extra>& extras) {
    const auto by_place = [](const Level& a, const Level& b) {
      return a.home != b.home ? a.home < b.home : a.p < b.p;
    };
    std::sort(extras.begin(), extras.end(),
              [&](const Extra& a, const Extra& b) { return by_place(a.level, b.level); });
    const Level* last = nullptr;
    for (Extra& e : extras) {
      S& value = e.level.value;
      auto above = std::upper_bound(vertices.begin(), vertices.end(), e.level, by_place);
      if (last && last->home == e.level.home) value = std::max(value, last->value);
      if (above != vertices.begin() && (above - 1)->home == e.level.home)
        value = std::max(value, (above - 1)->value);
      for (; above != vertices.end() && above->home == e.level.home && above->value < value; ++above)
        above->value = value;
      last = &e.level;
    }
  }

  /// Merges vertices and extras (both ascending) into the grid, equal levels once; the level index of each
  /// wanted state.
  static std::vector<State> merge(LevelGrid& grid, Levels vertices, const std::vector<Extra>& extras,
                                  const Order& before) {
    std::vector<State> level_of(extras.size());
    if (extras.empty()) {
      grid.levels_ = std::move(vertices);
    } else {
      grid.levels_.clear();
      grid.levels_.reserve(vertices.size() + extras.size());
      std::size_t next = 0;
      const auto add = [&](const Level& level) {
        if (grid.levels_.empty() || !before.is_same(grid.levels_.back(), level))
          grid.levels_.push_back(level);
      };
      for (const Extra& e : extras) {
        while (next < vertices.size() && !before(e.level, vertices[next])) add(vertices[next++]);
        add(e.level);
        level_of[e.wanted] = static_cast<State>(grid.levels_.size() - 1);
      }
      while (next < vertices.size()) add(vertices[next++]);
    }
    link(grid);
    return level_of;
  }

  /// Vertices around every level and the top level of every class.
  static void link(LevelGrid& grid) {
    const auto n = static_cast<State>(grid.levels_.size());
    State vertex = 0, n_vertices = 0;
    std::size_t c = 0;
    for (State i = 0; i < n; ++i) {
      Level& level = grid.levels_[index(i)];
      if (level.home != kOnChord) {
        vertex = i;
        ++n_vertices;
      }
      level.vertex_below = level.vertex_above = vertex;
      level.ordinal = n_vertices - 1;
      if (c < grid.classes_.size() && level.home == static_cast<std::int32_t>(c) &&
          level.value == grid.classes_[c].capacity && level.p + level.p == S(1))
        grid.classes_[c++].top = i;
    }
    for (State i = n - 1; i >= 0; --i) {
      Level& level = grid.levels_[index(i)];
      if (level.home != kOnChord) vertex = i;
      level.vertex_above = vertex;
    }
  }

  /// Fills the table of vertex concentrations, unless it would be large.
  static void tabulate(LevelGrid& grid) {
    constexpr std::size_t kLargest = std::size_t{1} << 22;
    const auto n = static_cast<std::size_t>(grid.levels_.back().ordinal) + 1;
    if (n * grid.classes_.size() > kLargest) return;
    std::vector<S> table(n * grid.classes_.size());
    std::vector<std::size_t> layer_of(grid.classes_.size());
    for (std::size_t k = 0; k < grid.n_layers(); ++k) layer_of[grid.layer_capacity_[k]] = k;
    for (std::size_t c = 0; c < grid.classes_.size(); ++c)
      for (State i = 0; i <= grid.classes_[c].top; ++i)
        if (const Level& level = grid.levels_[index(i)]; level.home != kOnChord)
          table[c * n + index(level.ordinal)] = grid.falling_phi(layer_of[c], i);
    grid.n_vertices_ = n;
    grid.vertex_phi_ = std::move(table);
  }

  /// Puts the phi of every extra between two vertices: exact phi, flux from the chord.
  static void place_on_chords(const LevelGrid& grid, std::vector<Extra>& extras,
                              const std::vector<LayerState<S>>& wanted) {
    for (Extra& e : extras) {
      const std::size_t layer = wanted[e.wanted].layer;
      const S p = falling(wanted[e.wanted].phi);
      State lo = 0, hi = grid.top(layer);  // largest vertex with phi <= p
      while (lo < hi) {
        const State mid = lo + (hi - lo + 1) / 2;
        if (grid.falling_phi(layer, mid) <= p) {
          lo = mid;
        } else {
          hi = mid - 1;
        }
      }
      const S phi_lo = grid.falling_phi(layer, lo);
      e.level = grid.levels_[index(lo)];
      if (!(p > phi_lo)) continue;
      const Level& upper = grid.levels_[index(lo + 1)];
      const S h_lo = e.level.value, h_hi = upper.value;
      const S position = (p - phi_lo) / (grid.falling_phi(layer, lo + 1) - phi_lo);
      // Between nearly equal capacities the value may round to that of the lower vertex, which is another
      // state. That of the upper one does no harm: before() puts chords before vertices.
      const S least = std::min(S(h_lo * (S(1) + S(2) * unit_roundoff<S>())), h_hi);
      const S value = std::min(std::max(S(h_lo + position * (h_hi - h_lo)), least), h_hi);
      if (value > h_lo && position < S(1)) {
        e.level = {value, position, kOnChord, 0, 0, 0};
      } else if (position + position >= S(1)) {
        e.level = upper;  // indistinguishable from the vertex
      }
    }
  }
};

template <Real S>
double LevelGrid<S>::exact_level_count(const LayerStack<S>& stack, const S& resolution) {
  LevelGrid grid;
  grid.set_classes(stack);
  return Draft::level_count(grid.classes_, resolution);
}

template <Real S>
void LevelGrid<S>::set_classes(const LayerStack<S>& stack) {
  boundaries_ = stack.boundaries();
  std::vector<S> capacities(stack.n_layers());
  for (std::size_t k = 0; k < capacities.size(); ++k) {
    const S depth = stack.flux(k).value(stack.flux(k).extrema().front());
    is_reversed_ = depth > S(0);
    capacities[k] = stack.rate(k) * stack.solid_fraction(k) * (is_reversed_ ? depth : S(-depth));
  }
  if (!stack.is_plain())
    for (std::size_t k = 0; k < capacities.size(); ++k) {
      const StateRange<S> range = stack.flux(k).range();
      ranges_.push_back({stack.solid_fraction(k) * range.lowest, stack.solid_fraction(k) * range.highest});
    }
  std::vector<S> distinct = capacities;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  for (const S& c : distinct) classes_.push_back({c, 0});
  for (const S& c : capacities)
    layer_capacity_.push_back(
        static_cast<std::uint32_t>(std::lower_bound(distinct.begin(), distinct.end(), c) - distinct.begin()));
}

template <Real S>
std::string LevelGrid<S>::refusal(const LayerStack<S>& stack) {
  std::optional<bool> is_maximum;
  for (const Flux<S>& flux : stack.fluxes()) {
    if (!flux.is_parabola()) return "a flux is not a parabola";
    const bool is_concave = flux.curvature() == Curvature::concave;
    if (is_maximum && *is_maximum != is_concave) return "a minimum faces a maximum";
    is_maximum = is_concave;
  }
  return {};
}

/// The wanted states as those of the quadratic flux.
template <Real S>
std::vector<LayerState<S>> unit_states(const LayerStack<S>& stack, std::vector<LayerState<S>> wanted,
                                       bool is_reversed) {
  if (stack.is_plain()) return wanted;
  for (LayerState<S>& state : wanted) {
    const StateRange<S> range = stack.flux(state.layer).range();
    const S distance = is_reversed ? range.highest - state.phi : state.phi - range.lowest;
    state.phi = distance / (range.highest - range.lowest);
  }
  return wanted;
}

template <Real S>
typename LevelGrid<S>::Built LevelGrid<S>::exact_levels(const LayerStack<S>& stack, const S& resolution,
                                                        const std::vector<LayerState<S>>& shares) {
  using Extra = typename Draft::Extra;
  SHEARFRONT_EXPECTS(resolution > 0 && resolution <= 1, "resolution in (0, 1]");
  Built built;
  LevelGrid& grid = built.grid;
  grid.set_classes(stack);
  const std::vector<LayerState<S>> wanted = unit_states(stack, shares, grid.is_reversed_);
  Levels vertices = Draft::vertices(grid.classes_, resolution);

  std::vector<Extra> extras;
  extras.reserve(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::uint32_t home = grid.layer_capacity_[wanted[i].layer];
    const S& capacity = grid.classes_[home].capacity;
    const S p = Draft::falling(wanted[i].phi);
    Level level{capacity * (S(4) * (p * (S(1) - p))), p, static_cast<std::int32_t>(home), 0, 0, 0};
    if (p == 0) level.home = 0;  // flux 0 is one level for all layers
    extras.push_back({std::move(level), i});
  }
  Draft::make_monotone(vertices, extras);
  typename Draft::Order order{grid.classes_};
  order.sort(extras);
  std::size_t n_distinct = 0;
  for (std::size_t i = 0; i < extras.size(); ++i)
    if (i == 0 || !order.is_same(extras[i - 1].level, extras[i].level)) ++n_distinct;
  const bool on_chords = n_distinct > kMaxExactStates && n_distinct > vertices.size();
  if (on_chords) {
    grid.levels_ = vertices;
    Draft::link(grid);
    Draft::place_on_chords(grid, extras, wanted);
    for (Extra& e : extras) e.level.vertex_below = e.level.vertex_above = e.level.ordinal = 0;
    order.rounded = true;
    order.sort(extras);
  }
  const std::vector<State> level_of = Draft::merge(grid, std::move(vertices), extras, order);
  if (on_chords) Draft::tabulate(grid);
  built.states.resize(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    built.states[i] =
        wanted[i].phi + wanted[i].phi <= S(1) ? level_of[i] : 2 * grid.top(wanted[i].layer) - level_of[i];
  return built;
}

template <Real S>
typename LevelGrid<S>::Built LevelGrid<S>::singular_mapping(const LayerStack<S>& stack, const S& delta,
                                                            const std::vector<LayerState<S>>& wanted) {
  using std::floor;
  SHEARFRONT_EXPECTS(delta > 0 && stack.is_plain(), "delta > 0, the quadratic flux");
  Built built;
  LevelGrid& grid = built.grid;
  grid.boundaries_ = stack.boundaries();
  std::vector<double> steps(stack.n_layers());
  for (std::size_t k = 0; k < steps.size(); ++k)
    steps[k] = std::max(1.0, std::round(to_double(S(stack.shear_rate(k) / delta))));
  std::vector<double> distinct = steps;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  const S quantum = stack.scale() * delta / S(4);
  for (const double k : distinct) grid.classes_.push_back({S(k) * quantum, static_cast<State>(k)});
  for (const double k : steps)
    grid.layer_capacity_.push_back(
        static_cast<std::uint32_t>(std::lower_bound(distinct.begin(), distinct.end(), k) - distinct.begin()));
  const auto n = static_cast<State>(distinct.back());
  for (State j = 0; j <= n; ++j)
    grid.levels_.push_back({S(static_cast<double>(j)) * quantum, S(0), kByValue, j, j, j});

  for (const LayerState<S>& state : wanted) {
    const State last = grid.n_states(state.layer) - 1;
    State lo = 0, hi = last;  // first state with phi >= wanted
    while (lo < hi) {
      const State mid = lo + (hi - lo) / 2;
      if (grid.phi(state.layer, mid) < state.phi) {
        lo = mid + 1;
      } else {
        hi = mid;
      }
    }
    if (lo > 0 && state.phi - grid.phi(state.layer, lo - 1) < grid.phi(state.layer, lo) - state.phi) --lo;
    built.states.push_back(lo);
  }
  return built;
}

template class LevelGrid<Instantiated>;

}  // namespace shearfront
