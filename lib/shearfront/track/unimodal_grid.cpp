// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/unimodal_grid.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <variant>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/instantiated.hpp"
#include "shearfront/riemann/flux_course.hpp"

namespace shearfront {
namespace {

constexpr int kRoundings = 8;  // of a flux value, in units of its last place
constexpr int kNewtonSteps = 8;

/// The flux of a class of layers along y, the distance from the state of index 0: h(y) rises up to the
/// extremum and falls after it.
template <Real S>
class Curve {
 public:
  Curve(const Flux<S>& flux, S strength, bool is_reversed)
      : flux_(flux), strength_(std::move(strength)), is_reversed_(is_reversed) {
    const S extremum = turning_state(flux);
    range_ = flux.range();
    width_ = range_.highest - range_.lowest;
    middle_ = distance(extremum);
    at_extremum_ = extremum;
    capacity_ = h(middle_);
  }

  [[nodiscard]] const S& width() const { return width_; }
  [[nodiscard]] const S& middle() const { return middle_; }
  [[nodiscard]] const S& capacity() const { return capacity_; }
  [[nodiscard]] S distance(const S& share) const {
    return is_reversed_ ? range_.highest - share : share - range_.lowest;
  }
  [[nodiscard]] S share(const S& y) const {
    if (y == middle_) return at_extremum_;
    if (y == width_) return is_reversed_ ? range_.lowest : range_.highest;
    return is_reversed_ ? range_.highest - y : range_.lowest + y;
  }
  [[nodiscard]] S h(const S& y) const { return h_of_share(share(y)); }
  [[nodiscard]] S h_of_share(const S& x) const {
    const S f = strength_ * flux_.value(x);
    return is_reversed_ ? f : S(-f);
  }
  /// dh/dy.
  [[nodiscard]] S slope(const S& y) const { return -strength_ * flux_.derivative(share(y)); }
  /// y between `from`, where h is not above `level`, and `to`, the extremum: Newton's method from `from`,
  /// which is near, and bracketing where that fails.
  [[nodiscard]] S solve(const S& level, const S& from, const S& to) const {
    using std::sqrt;
    const auto rest = [&](const S& y) { return S(h(y) - level); };
    const S at_from = rest(from);
    if (!(at_from < 0)) return from;
    if (!(level < capacity_)) return to;
    const bool is_upwards = from < to;
    const S enough = sqrt(unit_roundoff<S>()) / S(2);
    S y = from, at_y = at_from;
    for (int n = 0; n < kNewtonSteps; ++n) {
      const S steepness = slope(y);
      if (!(is_upwards ? steepness > 0 : steepness < 0)) break;
      const S next = y - at_y / steepness, step = next < y ? S(y - next) : S(next - y);
      if (!(is_upwards ? next > from && next < to : next < from && next > to)) break;
      // The next error is step^2 |h'' / 2 h'|, and h' vanishes nowhere but at the ends of a branch.
      const S to_middle = next < to ? S(to - next) : S(next - to);
      if (step < enough * std::min(to_middle, std::min(next, S(width_ - next)))) return next;
      y = next;
      at_y = rest(next);
    }
    std::uintmax_t n = 200;
    const boost::math::tools::eps_tolerance<S> tolerance(std::numeric_limits<S>::digits);
    const S at_to = rest(to);
    if (!(at_to > 0)) return to;
    const auto [a, b] = boost::math::tools::toms748_solve(
        rest, is_upwards ? from : to, is_upwards ? to : from, is_upwards ? at_from : at_to,
        is_upwards ? at_to : at_from, tolerance, n);
    return a + (b - a) / S(2);
  }

 private:
  const Flux<S>& flux_;
  S strength_;
  bool is_reversed_;
  StateRange<S> range_;
  S width_, middle_, at_extremum_, capacity_;
};

}  // namespace

/// Levels on their way into a grid.
template <Real S>
class UnimodalGrid<S>::Draft {
 public:
  Draft(UnimodalGrid& grid, const S& resolution) : grid_(grid), resolution_(resolution) {
    for (const Class& c : grid.classes_) {
      curves_.emplace_back(grid.fluxes_[c.flux], c.strength, grid.is_reversed_);
      branches_.push_back({S(0), curves_.back().width(), {}, {}});
    }
  }

  /// All levels and the shares of all states at them; the states of `wanted`.
  std::vector<State> build(const std::vector<LayerState<S>>& wanted) {
    std::vector<Wish> specials = specials_of(wanted);
    std::stable_sort(specials.begin(), specials.end(), [](const Wish& a, const Wish& b) {
      return a.h != b.h ? a.h < b.h : a.to_middle > b.to_middle;
    });
    std::vector<Place> places(wanted.size());
    for (std::size_t i = 0; i < specials.size();) {
      // All that have this level but for rounding; of one branch of one class only the first.
      std::vector<const Wish*> group;
      S h = specials[i].h;
      if (!grid_.levels_.empty()) {
        fill_up_to(h);
        h = std::max(h, S(grid_.levels_.back() + rounding(grid_.levels_.back())));
      }
      for (; i < specials.size() && specials[i].h <= h + rounding(h); ++i) {
        const Wish& s = specials[i];
        const bool is_other_state = std::any_of(group.begin(), group.end(), [&](const Wish* other) {
          return other->id == s.id && other->is_falling == s.is_falling && other->y != s.y;
        });
        if (is_other_state) break;
        group.push_back(&s);
      }
      add_level(h, group);
      for (const Wish* s : group) {
        grid_.specials_.push_back({static_cast<State>(grid_.levels_.size() - 1),
                                   static_cast<std::uint32_t>(s->id), s->is_falling, s->role,
                                   static_cast<std::uint32_t>(s->wanted.value_or(0))});
        if (s->wanted) places[*s->wanted] = {static_cast<State>(grid_.levels_.size() - 1), s->is_falling};
      }
    }
    finish();
    std::vector<State> states(wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const State t = grid_.top(wanted[i].layer);
      states[i] = places[i].is_falling ? places[i].level : 2 * t - places[i].level;
    }
    return states;
  }

 private:
  /// A state that must be in the grid.
  struct Wish {
    S h, y, to_middle;  ///< to_middle: distance from the extremum, relative to the width of the branch
    std::size_t id;     ///< class
    bool is_falling;
    typename Special::Role role;
    std::optional<std::size_t> wanted;
  };
  struct Place {
    State level = 0;
    bool is_falling = true;
  };
  /// y on both branches at the last level, and at all levels so far.
  struct Branches {
    S falling, rising;
    std::vector<S> all_falling, all_rising;
    std::size_t falling_from = 0, rising_from = 0;  ///< the first level at which there is a state
    bool is_done = false;
  };

  [[nodiscard]] static S rounding(const S& h) {
    return S(kRoundings) * unit_roundoff<S>() * (h < 0 ? S(-h) : h);
  }

  [[nodiscard]] std::vector<Wish> specials_of(const std::vector<LayerState<S>>& wanted) const {
    using Role = typename Special::Role;
    std::vector<Wish> specials;
    const auto add = [&](std::size_t id, const S& y, Role role, std::optional<std::size_t> number = {}) {
      const Curve<S>& curve = curves_[id];
      const bool is_falling = !(y > curve.middle());
      const S branch = is_falling ? curve.middle() : S(curve.width() - curve.middle());
      const S distance = is_falling ? S(curve.middle() - y) : S(y - curve.middle());
      const S to_middle = branch > 0 ? S(distance / branch) : S(0);
      specials.push_back(
          {std::min(curve.h(y), curve.capacity()), y, to_middle, id, is_falling, role, number});
    };
    for (std::size_t id = 0; id < curves_.size(); ++id) {
      add(id, S(0), Role::first_end);
      add(id, curves_[id].width(), Role::last_end);
      add(id, curves_[id].middle(), Role::extremum);
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const std::size_t id = grid_.layers_[wanted[i].layer].id;
      add(id, curves_[id].distance(wanted[i].phi), Role::wanted, i);
    }
    return specials;
  }

  /// Levels above the last one and below h, so that no state moves by more than the resolution.
  void fill_up_to(const S& h) {
    const S shy = S(1) - S(1e-9);  // a step that ends all but at h ends there
    for (;;) {
      const S last = grid_.levels_.back();
      S next = h;
      Maker maker;
      for (std::size_t id = 0; id < curves_.size(); ++id) {
        const Curve<S>& curve = curves_[id];
        const Branches& b = branches_[id];
        if (b.is_done) continue;
        const S step = resolution_ * curve.width();
        const auto take = [&](const S& y, bool is_falling) {
          const S candidate = curve.h(y);
          if (!(candidate > last + rounding(last)) || !(candidate < next)) return;
          next = candidate;
          maker = {static_cast<std::uint32_t>(id), is_falling};
        };
        if (!b.all_falling.empty()) take(std::min(S(b.falling + step), curve.middle()), true);
        if (!b.all_rising.empty()) take(std::max(S(b.rising - step), curve.middle()), false);
      }
      if (!(next - last < (h - last) * shy)) return;
      add_level(next, {}, maker);
    }
  }

  void add_level(const S& h, const std::vector<const Wish*>& group, Maker maker = {}) {
    const std::size_t number = grid_.levels_.size();
    grid_.levels_.push_back(h);
    grid_.makers_.push_back(maker);
    for (std::size_t id = 0; id < curves_.size(); ++id) {
      Branches& b = branches_[id];
      if (b.is_done) continue;
      const Curve<S>& curve = curves_[id];
      const auto given = [&](bool is_falling) {
        const auto it = std::find_if(group.begin(), group.end(), [&](const Wish* s) {
          return s->id == id && s->is_falling == is_falling;
        });
        return it == group.end() ? std::optional<S>() : std::optional<S>((*it)->y);
      };
      const auto falling = given(true), rising = given(false);
      if (falling || !b.all_falling.empty()) {
        if (b.all_falling.empty()) b.falling_from = number;
        b.falling = falling ? *falling : curve.solve(h, b.falling, curve.middle());
        b.all_falling.resize(number, S(0));
        b.all_falling.push_back(b.falling);
      }
      if (falling && *falling == curve.middle()) {
        b.rising = *falling;
        b.is_done = true;
        if (b.all_rising.empty()) b.rising_from = number;
        b.all_rising.resize(number, curve.width());
        grid_.classes_[id].top = static_cast<State>(number);
      } else if (rising || !b.all_rising.empty()) {
        if (b.all_rising.empty()) b.rising_from = number;
        b.rising = rising ? *rising : curve.solve(h, b.rising, curve.middle());
        b.all_rising.resize(number, curve.width());
        b.all_rising.push_back(b.rising);
      }
    }
  }

  void finish() {
    for (std::size_t id = 0; id < curves_.size(); ++id) {
      Class& c = grid_.classes_[id];
      const Branches& b = branches_[id];
      std::vector<S> share;
      share.reserve(index(2 * c.top + 1));
      for (const S& y : b.all_falling) share.push_back(curves_[id].share(y));
      for (auto y = b.all_rising.rbegin(); y != b.all_rising.rend(); ++y)
        share.push_back(curves_[id].share(*y));
      const auto first = static_cast<State>(b.falling_from), last = static_cast<State>(b.rising_from);
      c.polygon = {grid_.fluxes_[c.flux], std::move(share), first, 2 * c.top - last, grid_.is_reversed_};
    }
  }

  UnimodalGrid& grid_;
  const S& resolution_;
  std::vector<Curve<S>> curves_;
  std::vector<Branches> branches_;
};

template <Real S>
std::string UnimodalGrid<S>::refusal(const LayerStack<S>& stack, const S& resolution) {
  for (const Flux<S>& flux : stack.fluxes()) {
    const FluxCourse course = course_of(flux), first = course_of(stack.fluxes().front());
    if (course == FluxCourse::several_extrema)
      return "flux " + std::string(flux.name()) + " has several extrema";
    if (course != first) return "a minimum faces a maximum";
  }
  // Every level is kept for every layer that differs.
  constexpr double kMostStates = 2e8;
  const auto n = static_cast<double>(stack.n_layers());
  if (n * (2 / to_double(resolution) + 2 * n) > kMostStates)
    return "the grid would need too many states; use a coarser resolution or fewer layers";
  return {};
}

template <Real S>
typename UnimodalGrid<S>::Built UnimodalGrid<S>::exact_levels(const LayerStack<S>& stack, const S& resolution,
                                                              const std::vector<LayerState<S>>& wanted) {
  SHEARFRONT_EXPECTS(resolution > 0 && resolution <= 1, "resolution in (0, 1]");
  Built built;
  UnimodalGrid& grid = built.grid;
  grid.boundaries_ = stack.boundaries();
  grid.fluxes_ = stack.fluxes();
  grid.is_reversed_ = course_of(stack.fluxes().front()) == FluxCourse::maximum;
  grid.resolution_ = resolution;
  std::map<std::pair<std::size_t, S>, std::uint32_t> ids;
  for (std::size_t k = 0; k < stack.n_layers(); ++k) {
    const S strength = stack.rate(k) * stack.solid_fraction(k);
    const auto [it, is_new] =
        ids.try_emplace({stack.flux_index(k), strength}, static_cast<std::uint32_t>(grid.classes_.size()));
    if (is_new) grid.classes_.push_back({stack.flux_index(k), strength, 0, {}});
    grid.layers_.push_back({stack.rate(k), stack.solid_fraction(k), it->second});
  }
  built.states = Draft(grid, resolution).build(wanted);

  const auto zero = std::find(grid.levels_.begin(), grid.levels_.end(), S(0));
  if (zero != grid.levels_.end()) grid.zero_rank_ = -static_cast<State>(zero - grid.levels_.begin());
  for (const Layer& layer : grid.layers_)
    grid.fastest_ = std::max(grid.fastest_, S(layer.rate * grid.classes_[layer.id].polygon.steepest()));
  return built;
}

template class UnimodalGrid<Instantiated>;

}  // namespace shearfront
