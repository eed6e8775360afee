// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "shearfront/exact/end_derivatives.hpp"
#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {

namespace {

using exact::Path;
using exact::PathGradient;
using exact::PathKind;

template <class AnyDepthFunction>
auto knots_of(const AnyDepthFunction& a) {
  return std::visit([](const auto& model) { return model.knots(); }, a);
}

/// Whether c, T or the flux jumps at z.
template <Real Scalar>
bool material_jumps(const Scene<Scalar>& scene, const Scalar& z) {
  const auto has = [&](const std::vector<Scalar>& heights) {
    return std::find(heights.begin(), heights.end(), z) != heights.end();
  };
  return has(scene.flux_breaks()) ||
         (scene.spec().solid_fraction && has(knots_of(*scene.spec().solid_fraction))) ||
         (scene.spec().temperature && has(knots_of(*scene.spec().temperature)));
}

/// Whether two knots lie at one height, as at a jump of a table: one of them cannot move alone.
template <Real Scalar>
bool is_twice(const std::vector<Scalar>& knots, const Scalar& z) {
  return std::count(knots.begin(), knots.end(), z) > 1;
}

/// Where some entries lie among all of them.
struct EntryPlaces {
  std::size_t n, first_rate, scale, first_jump, first_state, first_start;

  template <Real Scalar>
  explicit EntryPlaces(const Scene<Scalar>& scene) {
    SceneSpec<Scalar> spec = scene.spec();
    const std::vector<Scalar*> places = entry_places(spec);
    const auto place = [&](const Scalar& number) {
      return static_cast<std::size_t>(std::find(places.begin(), places.end(), &number) - places.begin());
    };
    n = places.size();
    scale = place(spec.scale);  // follows the entries of the model
    first_rate = scale - std::visit([](auto& model) { return model_entries(model).size(); }, spec.shear_rate);
    first_jump = spec.initial_breaks.empty() ? n : place(spec.initial_breaks.front());
    first_state = spec.initial_values.empty() ? n : place(spec.initial_values.front());
    first_start = n;
    if (spec.initial_state)
      std::visit(
          [&](auto& model) {
            if (const auto own = model_entries(model); !own.empty()) first_start = place(*own.front());
          },
          *spec.initial_state);
  }
};

}  // namespace

template <Real Scalar>
std::string derivative_refusal(const Scene<Scalar>& scene, const Entry& entry) {
  const bool is_rate = entry.field.starts_with("shear_rate."), is_jump = entry.field == "initial.breaks";
  const bool is_start = scene.has_smooth_start() && entry.field.starts_with("initial.");
  if (!is_rate && !is_jump && !is_start && entry.field != "initial.values")
    return entry.field + " has no exact derivatives";
  if (!is_constant_in_pieces<Scalar>(scene.spec().solid_fraction))
    return "the solid fraction varies smoothly";
  if (!is_constant_in_pieces<Scalar>(scene.spec().temperature)) return "the temperature varies smoothly";
  if (is_start) return {};
  if (is_jump) {
    // With a solid fraction pieces of a smooth bed end at the initial jumps.
    const bool moves_layers = scene.spec().solid_fraction && !scene.is_layered();
    const auto knots = scene.knots();
    if (moves_layers && std::binary_search(knots.begin(), knots.end(), scene.initial_breaks()[entry.index]))
      return entry.name() + " lies on a knot of the bed";
    return {};
  }
  if (!is_rate) return {};
  std::size_t place = 0, found = kNoEntry;
  const std::vector<Entry> all = entries(scene.spec());
  for (const Entry& other : all) {
    if (!other.field.starts_with("shear_rate.")) continue;
    if (other.field == entry.field && other.index == entry.index) found = place;
    ++place;
  }
  const auto knots = knots_of(scene.shear_rate());
  const auto entry_of = std::visit([](const auto& model) { return knot_entries(model); }, scene.shear_rate());
  for (std::size_t i = 0; i < knots.size(); ++i)
    if (entry_of[i] == found &&
        (is_twice(knots, knots[i]) || (!scene.is_layered() && scene.jumps_at(knots[i]))))
      return entry.name() + " is one side of a jump";
  for (std::size_t i = 0; i < knots.size(); ++i)
    if (entry_of[i] == found && material_jumps(scene, knots[i]))
      return entry.name() + " lies on a jump of solid fraction, temperature or flux";
  return {};
}

template <Real Scalar>
struct Derivatives<Scalar>::Cut {
  Scalar z;
  std::vector<std::size_t> entries;  ///< that are this height
};

template <Real Scalar>
Derivatives<Scalar>::Derivatives(const ExactSolution<Scalar>& solution)
    : solution_(solution), form_(solution.form()) {
  const EntryPlaces places(solution.scene());
  n_entries_ = places.n;
  first_rate_ = places.first_rate;
  scale_ = places.scale;
  first_jump_ = places.first_jump;
  first_state_ = places.first_state;
  first_start_ = places.first_start;
  add_boundaries();
  add_pieces();
  add_initial();
}

/// The heights between which the layers are equal parts of a piece, and which entries move them.
template <Real Scalar>
auto Derivatives<Scalar>::cuts() const -> std::vector<Cut> {
  const Scene<Scalar>& scene = form_.scene();
  std::vector<Scalar> heights = scene.knots();
  const bool is_cut_at_jumps = scene.spec().solid_fraction && !form_.is_exact();
  if (is_cut_at_jumps) {
    heights.insert(heights.end(), scene.initial_breaks().begin(), scene.initial_breaks().end());
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  }
  std::vector<Cut> all{{scene.bottom(), {}}};
  for (const Scalar& z : heights) all.push_back({z, {}});
  all.push_back({scene.top(), {}});
  const auto mark = [&](const Scalar& z, std::size_t entry) {
    const auto it = std::lower_bound(all.begin() + 1, all.end() - 1, z,
                                     [](const Cut& cut, const Scalar& height) { return cut.z < height; });
    if (it != all.end() - 1 && it->z == z) it->entries.push_back(entry);
  };
  const auto knots = knots_of(scene.shear_rate());
  const auto entry_of = std::visit([](const auto& model) { return knot_entries(model); }, scene.shear_rate());
  for (std::size_t i = 0; i < knots.size(); ++i)
    if (entry_of[i] != kNoEntry && !is_twice(knots, knots[i])) mark(knots[i], first_rate_ + entry_of[i]);
  if (is_cut_at_jumps)
    for (std::size_t j = 0; j < scene.initial_breaks().size(); ++j)
      mark(scene.initial_breaks()[j], first_jump_ + j);
  return all;
}

/// Boundary k lies in a piece between two cuts, at the part w of it.
template <Real Scalar>
void Derivatives<Scalar>::add_boundaries() {
  const std::vector<Cut> all = cuts();
  std::size_t i = 0;
  for (std::size_t k = 0; k < form_.boundaries().size(); ++k) {
    const Scalar& z = form_.layers().boundary(k);
    while (i + 1 < all.size() && !(z < all[i + 1].z)) ++i;
    const Scalar stretch = form_.stretch(std::min(k, form_.layers().n_layers() - 1));
    const bool is_cut = all[i].z == z;
    const Scalar w = is_cut ? Scalar(0) : Scalar((z - all[i].z) / (all[i + 1].z - all[i].z));
    for (const std::size_t entry : all[i].entries)
      boundaries_.terms.push_back({entry, stretch * (Scalar(1) - w)});
    if (!is_cut)
      for (const std::size_t entry : all[i + 1].entries) boundaries_.terms.push_back({entry, stretch * w});
    boundaries_.close();
  }
}

template <Real Scalar>
std::vector<Scalar> Derivatives<Scalar>::boundary(std::size_t k) const {
  std::vector<Scalar> by(n_entries_, Scalar(0));
  const Scalar stretch = form_.stretch(std::min(k, form_.layers().n_layers() - 1));
  for (std::size_t i = boundaries_.begin[k]; i < boundaries_.begin[k + 1]; ++i)
    by[boundaries_.terms[i].entry] += boundaries_.terms[i].factor / stretch;
  return by;
}

template <Real Scalar>
void Derivatives<Scalar>::add_pieces() {
  const Scene<Scalar>& scene = form_.scene();
  if (form_.has_pieces()) {
    add_sloped_pieces();
    return;
  }
  const LayerStack<Scalar>& layers = form_.layers();
  const bool has_temperature = scene.spec().temperature.has_value();
  std::visit(
      [&](const auto& a) {
        for (std::size_t k = 0; k < layers.n_layers(); ++k) {
          const Scalar &lo = layers.boundary(k), &hi = layers.boundary(k + 1);
          Scalar factor = scene.scale() * form_.rate_factor(k);
          if (has_temperature) factor *= layers.shear_rate(k) / a.harmonic_mean(lo, hi);
          harmonic_mean_derivatives(a, lo, hi, [&](std::size_t entry, const Scalar& by) {
            pieces_.terms.push_back({first_rate_ + entry, factor * by});
          });
          pieces_.close();
        }
      },
      scene.shear_rate());
}

/// The rates at the ends of a piece by the entries that a(z) depends on there; the ends move with their knots.
template <Real Scalar>
void Derivatives<Scalar>::add_sloped_pieces() {
  const LayerStack<Scalar>& layers = form_.layers();
  const Scene<Scalar>& scene = form_.scene();
  if (!is_constant_in_pieces<Scalar>(scene.spec().temperature)) {  // all entries are refused
    for (std::size_t k = 0; k < 2 * layers.n_layers(); ++k) pieces_.close();
    return;
  }
  std::visit(
      [&](const auto& a) {
        for (std::size_t k = 0; k < layers.n_layers(); ++k) {
          const Scalar &lo = layers.boundary(k), &hi = layers.boundary(k + 1);
          const auto ends = end_values(a, lo, hi);
          const Scalar factor = form_.low_rates()[k] / ends.low;
          std::vector<Term> at_low, at_high;
          exact::for_each_end_derivative(a, lo, hi,
                                         [&](std::size_t entry, const Scalar& low, const Scalar& high) {
                                           if (low != Scalar(0))
                                             at_low.push_back({first_rate_ + entry, factor * low});
                                           if (high != Scalar(0))
                                             at_high.push_back({first_rate_ + entry, factor * high});
                                         });
          const auto add = [&](std::size_t boundary, std::vector<Term>& terms, const Scalar& slope) {
            const Scalar stretch = form_.stretch(std::min(boundary, layers.n_layers() - 1));
            for (std::size_t n = boundaries_.begin[boundary]; n < boundaries_.begin[boundary + 1]; ++n)
              terms.push_back(
                  {boundaries_.terms[n].entry, factor * slope / stretch * boundaries_.terms[n].factor});
            pieces_.terms.insert(pieces_.terms.end(), terms.begin(), terms.end());
            pieces_.close();
          };
          const EndValues<Scalar> slopes = exact::end_slopes(a, lo, hi);
          add(k, at_low, slopes.low);
          add(k + 1, at_high, slopes.high);
        }
      },
      scene.shear_rate());
}

template <Real Scalar>
void Derivatives<Scalar>::add_initial() {
  const Scene<Scalar>& scene = form_.scene();
  for (std::size_t j = 0; j < form_.initial_breaks().size(); ++j) {
    const std::size_t i = form_.initial_break(j);
    if (i != form_.kNone)
      jumps_.terms.push_back(
          {first_jump_ + i, form_.stretch(form_.layers().layer_at(scene.initial_breaks()[i]))});
    jumps_.close();
  }
  for (std::size_t j = 0; j < form_.initial_values().size(); ++j) {
    states_.terms.push_back(
        {first_state_ + form_.initial_piece(j), Scalar(1) / form_.state_slope(form_.initial_layer(j))});
    states_.close();
  }
}

template <Real Scalar>
void Derivatives<Scalar>::spread(const Chain& chain, std::size_t n, const Pair& by, At& out) const {
  if (by.M == 0 && by.phi == 0) return;
  Scalar *M = out.M.data(), *phi = out.phi.data();
  const Term *term = chain.terms.data() + chain.begin[n], *end = chain.terms.data() + chain.begin[n + 1];
  for (; term != end; ++term) {
    M[term->entry] += by.M * term->factor;
    phi[term->entry] += by.phi * term->factor;
  }
}

/// Of a smooth start: int_bottom^y u(., 0) and u(y, 0), times these.
template <Real Scalar>
void Derivatives<Scalar>::add_start_shape(const Scalar& y, const Scalar& by_amount, const Scalar& by_state,
                                          At& out) const {
  const auto& cells = solution_.medium().cells();
  form_.start()->derivatives(cells.layer[cells.cell_at(y)], y,
                             [&](std::size_t entry, const Scalar& state, const Scalar& amount) {
                               out.M[first_start_ + entry] += by_amount * amount;
                               out.phi[first_start_ + entry] += by_state * state;
                             });
}

/// Derivatives of int_bottom^y u(., 0) at fixed y. A jump at y itself counts as lying at y - 0: the caller
/// adds what its own movement does to the path.
template <Real Scalar>
void Derivatives<Scalar>::add_initial_cumulative(const Scalar& y, bool include_jump_at_y, At& out) const {
  const auto& jumps = form_.initial_breaks();
  const auto& states = form_.initial_values();
  if (form_.start()) return add_start_shape(y, Scalar(1), Scalar(0), out);
  for (std::size_t j = 0; j < states.size(); ++j) {
    const Scalar& lo = j == 0 ? form_.boundaries().front() : jumps[j - 1];
    if (!(lo < y)) break;
    const bool last = j == jumps.size();
    const Scalar& hi = last ? form_.boundaries().back() : jumps[j];
    spread(states_, j, {std::min(y, hi) - lo, Scalar(0)}, out);
    if (!last && (hi < y || (include_jump_at_y && hi == y)))
      spread(jumps_, j, {states[j] - states[j + 1], Scalar(0)}, out);
  }
}

/// The source of the path moves: an initial jump, or an interface without one.
template <Real Scalar>
void Derivatives<Scalar>::add_start(const Path<Scalar>& path, const PathGradient<Scalar>& gradient,
                                    At& out) const {
  const auto& jumps = form_.initial_breaks();
  const auto jump = std::lower_bound(jumps.begin(), jumps.end(), path.foot);
  const auto j = static_cast<std::size_t>(jump - jumps.begin());
  if (form_.start() && path.is_state) return;
  const Scalar& below =
      form_.start() ? solution_.medium().cells().beside(path.source, false) : form_.initial_values()[j];
  const Pair by{gradient.start.against(below), gradient.phi_start};
  if (jump != jumps.end() && *jump == path.foot && form_.initial_break(j) != form_.kNone) {
    spread(jumps_, j, by, out);
    return;
  }
  const auto& boundaries = form_.boundaries();
  const auto boundary = std::lower_bound(boundaries.begin(), boundaries.end(), path.foot);
  if (boundary != boundaries.end() && *boundary == path.foot)
    spread(boundaries_, static_cast<std::size_t>(boundary - boundaries.begin()), by, out);
}

template <Real Scalar>
void Derivatives<Scalar>::add_path(const Path<Scalar>& path, const Scalar& y, const Scalar& t,
                                   At& out) const {
  out.M[scale_] = path.H * t / form_.scene().scale();
  add_initial_cumulative(path.foot, path.kind == PathKind::constant, out);
  const PathGradient<Scalar> gradient = solution_.medium().gradient(path, y, t);
  out.phi[scale_] = gradient.phi_log_scale / form_.scene().scale();
  const std::size_t per_piece = solution_.medium().numbers_per_piece();
  for (std::size_t n = 0; n < gradient.pieces.size(); ++n)
    spread(pieces_, gradient.first * per_piece + n, gradient.pieces[n], out);
  for (std::size_t n = 1; n < gradient.boundaries.size(); ++n)
    spread(boundaries_, gradient.first + n, gradient.boundaries[n], out);
  if (path.kind == PathKind::constant && form_.start()) {
    add_start_shape(path.foot, Scalar(0), gradient.phi_state, out);
  } else if (path.kind == PathKind::constant) {
    const auto& cells = solution_.medium().cells();
    const auto& jumps = form_.initial_breaks();
    const auto j = std::upper_bound(jumps.begin(), jumps.end(), cells.x[path.source]) - jumps.begin();
    spread(states_, static_cast<std::size_t>(j), {Scalar(0), gradient.phi_state}, out);
  }
  if (path.kind == PathKind::fan || path.kind == PathKind::waiting) add_start(path, gradient, out);
}

template <Real Scalar>
void Derivatives<Scalar>::clear(At& out) const {
  out.M.assign(n_entries_, Scalar(0));
  out.phi.assign(n_entries_, Scalar(0));
}

template <Real Scalar>
void Derivatives<Scalar>::at(const Scalar& z, const Scalar& t, At& out) const {
  const bool is_initial = t == Scalar(0);
  if (!is_initial && is_finite(t)) return along(solution_.path(z, t), z, t, out);
  clear(out);
  const Scalar y = form_.image_of(z);
  out.value = solution_.at(z, t);
  const auto& jumps = form_.initial_breaks();
  const auto j = std::upper_bound(jumps.begin(), jumps.end(), y) - jumps.begin();
  if (is_initial && form_.start())
    add_start_shape(y, Scalar(0), Scalar(1), out);
  else if (is_initial)
    spread(states_, static_cast<std::size_t>(j), {Scalar(0), Scalar(1)}, out);
  const bool below = !is_initial && y < solution_.medium().steady_height();
  if (!below) add_initial_cumulative(is_initial ? y : form_.boundaries().back(), true, out);
  scale_to_scene(z, out);
}

template <Real Scalar>
void Derivatives<Scalar>::along(const Path<Scalar>& path, const Scalar& z, const Scalar& t, At& out) const {
  clear(out);
  out.value = solution_.value_of(path, z, t);
  add_path(path, form_.image_of(z), t, out);
  scale_to_scene(z, out);
}

/// From the canonical form.
template <Real Scalar>
void Derivatives<Scalar>::scale_to_scene(const Scalar& z, At& out) const {
  if (form_.is_identity()) return;
  const std::size_t k = form_.layers().layer_at(z);
  const Scalar slope = form_.state_slope(k) * form_.layers().solid_fraction(k);
  for (Scalar& by : out.M) by *= form_.sign();
  for (Scalar& by : out.phi) by *= slope;
}

template class Derivatives<Instantiated>;
template std::string derivative_refusal(const Scene<Instantiated>&, const Entry&);

}  // namespace shearfront
