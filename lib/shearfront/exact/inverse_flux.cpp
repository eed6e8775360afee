// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/inverse_flux.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

template <Real Scalar>
InverseFlux<Scalar>::InverseFlux(Flux<Scalar> flux) : flux_(std::move(flux)) {
  const auto range = flux_.range();
  is_concave_ = flux_.curvature() == Curvature::concave;
  lowest_ = range.lowest, highest_ = range.highest;
  width_ = range.highest - range.lowest;
  extremum_ = flux_.extrema().front();
  depth_ = size(flux_.value(extremum_));
  peak_ = (is_concave_ ? range.highest - extremum_ : extremum_ - range.lowest) / width_;
  is_smooth_ = with_model(flux_, [&]<class Model>(const Model& f) {
    return Model::kIsParabola || requires { f.second_derivative(extremum_); };
  });
  with_model(flux_, [&](const auto& f) {
    if constexpr (requires { f.joints(); }) {
      for (const Scalar& x : f.joints())
        for (const bool up : {false, true}) {
          const Scalar m = size(x - pure_share(up)) / width_;
          if (m > 0 && m < reach(up)) joints_[up].push_back(m);
        }
    }
  });
  for (auto& joints : joints_) std::sort(joints.begin(), joints.end());
  const Scalar near = width_ / Scalar(1 << 20);
  // A smooth flux has no slope at its extremum, up to rounding; a kink keeps those of its two sides.
  if (!(size(flux_.derivative(extremum_)) * width_ <= depth_ / Scalar(1 << 16)))
    for (const bool up : {true, false})
      kink_[up] =
          size(flux_.secant(extremum_, Scalar(up == is_concave_ ? extremum_ - near : extremum_ + near))) *
          width_ / depth_;
  with_model(flux_, [&]<class Model>(const Model& f) {
    if constexpr (degree_between_joints<Model>() <= 3)
      for (const bool up : {false, true}) branches_.push_back(branch_of(f, up));
  });
}

/// From the slopes and bends inside the pieces: at joints a model says those of one side.
template <Real Scalar>
template <class Model>
FluxBranch<Scalar> InverseFlux<Scalar>::branch_of(const Model& f, bool up) const {
  const Scalar zero(0), two(2), four(4), six(6);
  if constexpr (Model::kIsParabola) return {reach(up), {{zero, zero, four, -four, zero}}, zero, four, zero};
  // As functions of m.
  const auto slope = [&](const Scalar& m) { return Scalar(slope_of(f, Scalar(reach(up) - m), up)); };
  const auto bend = [&](const Scalar& m) -> Scalar {  // G''
    if constexpr (degree_between_joints<Model>() < 2)
      return zero;
    else
      return -bend_of(f, Scalar(reach(up) - m), up);
  };
  std::vector<Scalar> ends{zero};
  ends.insert(ends.end(), joints_[up].begin(), joints_[up].end());
  ends.push_back(reach(up));
  std::vector<typename FluxBranch<Scalar>::Piece> pieces;
  Scalar at_peak(0), third(0);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const Scalar &lo = ends[i], width = ends[i + 1] - lo, middle = lo + width / two;
    third = (bend(Scalar(lo + width * Scalar(0.75))) - bend(Scalar(lo + width / four))) / (width / two);
    const Scalar in_middle = bend(middle), begin = in_middle - third * width / two;
    at_peak = in_middle + third * width / two;
    const Scalar first = i == 0 ? Scalar(size(f.derivative(pure_share(up))) * (width_ / depth_))
                                : Scalar(slope(middle) - width / two * (in_middle - third * width / four));
    pieces.push_back({lo, i == 0 ? zero : Scalar(Scalar(1) - lack_of(f, Scalar(reach(up) - lo), up)), first,
                      begin / two, third / six});
  }
  return {reach(up), std::move(pieces), kink_[up], -at_peak / two, third / six};
}

template <Real Scalar>
template <class Model>
Scalar InverseFlux<Scalar>::lack_of(const Model& f, const Scalar& d, bool up) const {
  if constexpr (Model::kIsParabola) return Scalar(4) * d * d;
  return size(f.secant(extremum_, place(d, up))) * (width_ * d / depth_);
}

template <Real Scalar>
template <class Model>
Scalar InverseFlux<Scalar>::slope_of(const Model& f, const Scalar& d, bool up) const {
  if constexpr (Model::kIsParabola) return Scalar(8) * d;
  const Scalar x = place(d, up);
  if (x == extremum_) return kink_[up];
  return size(f.derivative(x)) * (width_ / depth_);
}

template <Real Scalar>
template <class Model>
Scalar InverseFlux<Scalar>::bend_of(const Model& f, const Scalar& d, bool up) const {
  if constexpr (Model::kIsParabola) {
    return Scalar(8);
  } else if constexpr (requires { f.second_derivative(extremum_); }) {
    return size(f.second_derivative(place(d, up))) * (width_ * width_ / depth_);
  } else {
    const Scalar step = Scalar(1) / Scalar(1 << 13);
    const Scalar lo = d > step ? Scalar(d - step) : Scalar(0);
    const Scalar hi = d + step < reach(up) ? Scalar(d + step) : reach(up);
    return (slope_of(f, hi, up) - slope_of(f, lo, up)) / (hi - lo);
  }
}

template <Real Scalar>
template <class Model>
Scalar InverseFlux<Scalar>::inverse_of(const Model& f, const Scalar& e, bool up) const {
  using std::sqrt;
  const Scalar root = sqrt(e);
  if constexpr (Model::kIsParabola) return root / Scalar(2);
  const Scalar most = reach(up);
  Scalar d = most * root;
  constexpr int kMostSteps = 200;
  for (int n = 0; n < kMostSteps; ++n) {
    const Scalar slope = slope_of(f, d, up);
    if (!(slope > 0)) break;
    Scalar next = d - (lack_of(f, d, up) - e) / slope;
    if (next > most) next = most;
    if (!(next > 0)) break;
    // After the first step every d lies above the root: no further decrease means rounding.
    if (n > 0 && !(next < d)) break;
    d = next;
  }
  return d;
}

/// G is concave, so Newton's method from below never passes the root.
template <Real Scalar>
template <class Model>
Scalar InverseFlux<Scalar>::distance_of(const Model& f, const Scalar& G, bool up) const {
  const Scalar& pure = pure_share(up);
  const Scalar most = reach(up);
  Scalar distance = G * depth_ / (size(f.derivative(pure)) * width_);
  constexpr int kMostSteps = 200;
  for (int n = 0; n < kMostSteps && distance < most; ++n) {
    const Scalar x = place_beside(distance, up);
    const Scalar rest = G * depth_ - size(f.secant(pure, x)) * (width_ * distance);
    const Scalar next = distance + rest / (size(f.derivative(x)) * width_);
    if (!(next > distance)) break;
    distance = next;
  }
  return distance < most ? distance : most;
}

template <Real Scalar>
Scalar InverseFlux<Scalar>::flux_beside(const Scalar& distance, bool up) const {
  if (const auto* of = branch(up)) return of->height_beside(distance);
  return size(flux_.secant(pure_share(up), place_beside(distance, up))) * (width_ * distance / depth_);
}

template <Real Scalar>
Scalar InverseFlux<Scalar>::distance_beside(const Scalar& G, bool up) const {
  if (const auto* of = branch(up)) return G > 0 ? of->distance(G) : Scalar(0);
  return with_model(flux_, [&](const auto& f) { return distance_of(f, G, up); });
}

template <Real Scalar>
auto InverseFlux<Scalar>::rise_beside(const Scalar& distance, bool up) const -> Rise {
  if (const auto* of = branch(up)) return {of->chord(distance), of->slope_beside(distance)};
  const Scalar &pure = pure_share(up), x = place_beside(distance, up);
  return with_model(flux_, [&](const auto& f) -> Rise {
    // At a kink the slope is that of the side.
    const Scalar slope =
        distance < reach(up) ? Scalar(size(f.derivative(x)) * (width_ / depth_)) : slope_of(f, Scalar(0), up);
    return {size(f.secant(pure, x)) * (width_ / depth_), slope};
  });
}

template <Real Scalar>
Scalar InverseFlux<Scalar>::chord_beside(const Scalar& distance1, const Scalar& distance2, bool up) const {
  if (const auto* of = branch(up)) return of->chord(distance1, distance2);
  const Scalar x = place_beside(distance1, up), y = place_beside(distance2, up);
  return with_model(flux_, [&](const auto& f) { return size(f.secant(x, y)) * (width_ / depth_); });
}

template <Real Scalar>
Scalar InverseFlux<Scalar>::lack(const Scalar& d, bool up) const {
  if (const auto* of = branch(up)) return of->lack(d);
  return with_model(flux_, [&](const auto& f) { return lack_of(f, d, up); });
}

template <Real Scalar>
Scalar InverseFlux<Scalar>::slope(const Scalar& d, bool up) const {
  if (const auto* of = branch(up)) return of->slope(d);
  return with_model(flux_, [&](const auto& f) { return slope_of(f, d, up); });
}

template <Real Scalar>
Scalar InverseFlux<Scalar>::bend(const Scalar& d, bool up) const {
  if (const auto* of = branch(up)) return of->bend(d);
  return with_model(flux_, [&](const auto& f) { return bend_of(f, d, up); });
}

template <Real Scalar>
Scalar InverseFlux<Scalar>::inverse(const Scalar& e, bool up) const {
  if (!(e > 0)) return Scalar(0);
  if (!(e < 1)) return reach(up);
  if (const auto* of = branch(up)) return of->inverse(e);
  return with_model(flux_, [&](const auto& f) { return inverse_of(f, e, up); });
}

template class InverseFlux<Instantiated>;

}  // namespace shearfront::exact
