// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/exact_solution.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "shearfront/exact/refusal.hpp"
#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {

template <Real Scalar>
auto ExactSolution<Scalar>::represent(std::shared_ptr<const Scene<Scalar>> scene, std::size_t layers)
    -> Representation {
  Representation of;
  of.form = std::make_shared<const exact::CanonicalForm<Scalar>>(std::move(scene), layers);
  of.medium = exact::make_medium(*of.form);
  return of;
}

template <Real Scalar>
ExactSolution<Scalar>::ExactSolution(const Scene<Scalar>& scene, Options options) : mass_(scene.mass()) {
  SHEARFRONT_EXPECTS(exact::refusal(scene).empty(), "a scene with an exact solution");
  const auto shared = std::make_shared<const Scene<Scalar>>(scene);
  resolution_ = options.layers > 0 ? options.layers : kFirstPieces;
  fine_ = represent(shared, resolution_);
  if (!form().is_final()) {
    coarse_ = represent(shared, (resolution_ + 1) / 2);
    if (options.layers == 0) represent_within(shared, options.tolerance);
  }
  steady_height_ = form().height_of(medium().steady_height());
}

/// Doubles the number of pieces until their error is within the tolerance. It falls to a quarter each time: what is not
/// needed on the way is left out.
template <Real Scalar>
void ExactSolution<Scalar>::represent_within(const std::shared_ptr<const Scene<Scalar>>& scene,
                                             double tolerance) {
  for (std::size_t n = resolution_;;) {
    probed_error_ = probe();
    const double error = to_double(probed_error_);
    meets_tolerance_ = error <= tolerance;
    const std::size_t most = form().is_exact() ? kMostParts : kMostPieces;
    if (meets_tolerance_ || n >= most) return;
    std::size_t next = 2 * n;
    for (double left = error / 4; !form().is_exact() && left > tolerance && next < most; left /= 4) next *= 2;
    coarse_ = next == 2 * n ? std::move(fine_) : represent(scene, next / 2);
    fine_ = represent(scene, next);
    resolution_ = n = next;
  }
}

/// Largest M_error over probe points, in heights of the bed: times from the first arrivals to the steady state.
template <Real Scalar>
Scalar ExactSolution<Scalar>::probe() const {
  const Scalar height = scene().top() - scene().bottom();
  const Scalar crossing = medium().pure_travel_time(medium().bottom(), medium().top());
  constexpr int kHeights = 9;
  Scalar worst(0);
  for (const double share : {0.125, 0.25, 0.5, 1.0, 2.0})
    for (int i = 1; i <= kHeights; ++i) {
      const Scalar z = scene().bottom() + height * Scalar(i) / Scalar(kHeights + 1);
      worst = std::max(worst, at(z, Scalar(crossing * Scalar(share))).M_error);
    }
  return worst / height;
}

template <Real Scalar>
std::size_t ExactSolution<Scalar>::n_layers() const {
  return form().layers().n_layers();
}

/// A value of the canonical form as one of the scene.
template <Real Scalar>
auto ExactSolution<Scalar>::in_scene(const Representation& of, Value value, const Scalar& z) const -> Value {
  const exact::CanonicalForm<Scalar>& form = *of.form;
  if (form.is_identity()) return value;
  value.phi = form.phi_of(z, value.phi);
  value.M = z == form.scene().top() ? mass_ : form.amount_of(z, value.M);
  value.H *= form.sign();
  return value;
}

template <Real Scalar>
auto ExactSolution<Scalar>::image_value(const exact::Medium<Scalar>& medium, const Path& path,
                                        const Scalar& y) -> Value {
  const Scalar& mass = medium.mass();
  Value value;
  const Scalar low = std::max(Scalar(0), Scalar(mass - (medium.top() - y)));
  const Scalar high = std::min(Scalar(y - medium.bottom()), mass);
  value.M = y == medium.top() ? mass : std::max(low, std::min(high, path.value));
  value.phi = std::min(Scalar(1), std::max(Scalar(0), path.p));
  // A path may end on an interface with a flux that only the layer it comes from can carry, if it sets out
  // within rounding of the interface: no flux through it exceeds what the layer above carries.
  value.H = std::min(path.H, Scalar(medium.rate_at(y) / Scalar(4)));
  return value;
}

template <Real Scalar>
exact::Path<Scalar> ExactSolution<Scalar>::path(const Scalar& z, const Scalar& t) const {
  if (t == Scalar(0) || !is_finite(t)) return {};
  return medium().best_path(form().image_of(z), t);
}

/// The initial data, or the steady state.
template <Real Scalar>
auto ExactSolution<Scalar>::value_at_rest(const Scalar& z, bool is_initial) const -> Value {
  const Scalar y = form().image_of(z), &mass = medium().mass();
  Value value;
  if (is_initial) {
    const auto& cells = medium().cells();
    value.phi = cells.state(cells.cell_at(y), y);
    value.M = y == medium().top() ? mass : std::min(cells.cumulative(y), mass);
    value.H = medium().flux_at(y, value.phi);
  } else {
    const Scalar steady = medium().steady_height();
    value.phi = Scalar(y >= steady && steady < medium().top() ? 0 : 1);
    value.M = std::min(Scalar(y - medium().bottom()), mass);
  }
  value = in_scene(fine_, std::move(value), z);
  if (is_initial) value.phi = scene().initial_phi(z);
  return value;
}

template <Real Scalar>
auto ExactSolution<Scalar>::at(const Scalar& z, const Scalar& t) const -> Value {
  SHEARFRONT_EXPECTS(z >= scene().bottom() && z <= scene().top() && t >= Scalar(0), "a point of the domain");
  if (t == Scalar(0) || !is_finite(t)) return value_at_rest(z, t == Scalar(0));
  return value_of(path(z, t), z, t);
}

template <Real Scalar>
auto ExactSolution<Scalar>::value_of(const Path& path, const Scalar& z, const Scalar& t) const -> Value {
  Value value = in_scene(fine_, image_value(path, form().image_of(z)), z);
  if (is_exact()) return value;
  return with_errors(std::move(value), coarse_.medium->best_path(coarse_.form->image_of(z), t), z);
}

template <Real Scalar>
auto ExactSolution<Scalar>::paths(const Representation& of, const std::vector<Scalar>& z, const Scalar& t)
    -> std::vector<Path> {
  if (of.form->is_identity()) return of.medium->best_paths(z, t);
  std::vector<Scalar> y;
  y.reserve(z.size());
  for (const Scalar& height : z) y.push_back(of.form->image_of(height));
  return of.medium->best_paths(y, t);
}

template <Real Scalar>
auto ExactSolution<Scalar>::paths(const std::vector<Scalar>& z, const Scalar& t) const -> std::vector<Path> {
  return paths(fine_, z, t);
}

template <Real Scalar>
auto ExactSolution<Scalar>::at(const std::vector<Scalar>& z, const Scalar& t) const -> std::vector<Value> {
  std::vector<Value> values;
  values.reserve(z.size());
  if (t == Scalar(0) || !is_finite(t)) {
    for (const Scalar& height : z) values.push_back(at(height, t));
    return values;
  }
  const std::vector<Path> fine = paths(fine_, z, t),
                          coarse = is_exact() ? std::vector<Path>{} : paths(coarse_, z, t);
  for (std::size_t i = 0; i < z.size(); ++i) {
    Value value = in_scene(fine_, image_value(fine[i], form().image_of(z[i])), z[i]);
    values.push_back(is_exact() ? std::move(value) : with_errors(std::move(value), coarse[i], z[i]));
  }
  return values;
}

/// What the change from half as many pieces tells.
template <Real Scalar>
auto ExactSolution<Scalar>::with_errors(Value value, const Path& coarse_path, const Scalar& z) const
    -> Value {
  const Scalar y = coarse_.form->image_of(z);
  const Value coarse = in_scene(coarse_, image_value(*coarse_.medium, coarse_path, y), z);
  const auto change = [](const Scalar& a, const Scalar& b) { return a > b ? Scalar(a - b) : Scalar(b - a); };
  // Second order leaves a third of the change, order 3/2 leaves 1 / (2^(3/2) - 1) = 0.55 of it on average.
  value.M_error = change(coarse.M, value.M);
  value.phi_error = change(coarse.phi, value.phi);
  return value;
}

template class ExactSolution<Instantiated>;

}  // namespace shearfront
