// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>

#include "shearfront/exact/arc.hpp"
#include "shearfront/exact/arc_derivatives.hpp"
#include "shearfront/exact/medium.hpp"
#include "shearfront/exact/piece_numbers.hpp"
#include "shearfront/exact/sloped_bed.hpp"

namespace shearfront::exact {

/// Derivatives along a path of a parabola that does not leave its piece, a turn included, in closed form. From a smooth start u0 the
/// height y where it begins is a root of y + rise(u0(y)) = z, and moves with everything.
template <Real Scalar>
class ArcGradient {
 public:
  ArcGradient(const SlopedPieces<Scalar>& pieces, const Cells<Scalar>& cells, const Path<Scalar>& path,
              std::size_t piece, const Scalar& z, const Scalar& t, PieceNumbers<Scalar>& numbers,
              PathGradient<Scalar>& out)
      : pieces_(pieces),
        cells_(cells),
        path_(path),
        end_(piece),
        z_(z),
        t_(t),
        numbers_(numbers),
        out_(out) {}

  void run() { pieces_.form[end_] == RateForm::linear ? in_linear_piece() : in_exponential_piece(); }

 private:
  /// A path that does not leave a linear piece: by r at its start or end and by the slope. Of a state logit phi = logit p0 + b t.
  void in_linear_piece() {
    const Scalar one(1), &slope = pieces_.bend[end_], width = pieces_.width(end_);
    const LinearDrift<Scalar> drift(slope, t_);
    StartMomentum<Scalar> start;
    Scalar by_slope;
    if (path_.kind == PathKind::constant) {
      const Scalar p0 = cells_.state(path_.source, path_.foot);
      start = {p0, one - p0};
      const Scalar D = start.p * drift.u + start.missing * drift.v;
      out_.phi_state = drift.u / D * (drift.v / D);
      by_slope = out_.phi_state * start.p * start.missing * t_;
      out_.phi_log_scale = by_slope * slope;
      if (cells_.is_curved(path_.source)) {
        const LinearRise<Scalar> rise(drift, slope, t_, start.p, start.missing, numbers_.at(end_, z_));
        const Scalar steep = cells_.slope(path_.source, path_.foot), all = one + rise.by_state * steep;
        const Scalar shift = -steep / all * out_.phi_state;  // dphi by what the way to z grows
        out_.phi_state /= all;
        by_slope += shift * rise.by_slope;
        out_.phi_log_scale += shift * (rise.size + slope * rise.by_slope);
        numbers_.add_at(end_, z_, Scalar(0), shift * rise.by_rate);
      }
    } else {
      const Scalar r = numbers_.at(end_, z_), d = z_ - path_.foot;
      const auto arc = arc_from_point(RateForm::linear, slope, t_, d, numbers_.at(end_, path_.foot), r);
      const auto by = linear_fan_derivatives(arc, drift, slope, t_, d, r);
      const Scalar p = arc.p * drift.v, missing = arc.missing * drift.u;
      start = {p / (p + missing), missing / (p + missing)};
      out_.start = start;
      out_.phi_start = by.by_start;
      out_.phi_log_scale = by.by_log_scale;
      by_slope = by.by_slope;
      numbers_.add_at(end_, z_, Scalar(0), by.by_rate);
    }
    numbers_.number(end_, true).phi += by_slope / width;
    numbers_.number(end_, false).phi -= by_slope / width;
    if (!(path_.H > 0)) return;
    const LinearArcIntegrals<Scalar> integrals(path_.H, drift, slope, t_, start.p, start.missing);
    numbers_.add_at(end_, path_.foot, integrals.level, Scalar(0));
    numbers_.number(end_, true).M += integrals.height / width;
    numbers_.number(end_, false).M -= integrals.height / width;
  }

  /// A path that does not leave an exponential piece: by log r at its start or end and by kappa = |r'/r|, which are
  ///   log r(z) = w_low log r_low + w_high log r_high,   kappa = log(near / far) / width,
  /// near the end with the larger rate. Where r rises all is turned upside down.
  void in_exponential_piece() {
    using std::expm1;
    const Scalar one(1), &bend = pieces_.bend[end_];
    const bool is_rising = bend > 0;
    const Scalar kappa = is_rising ? bend : Scalar(-bend), sign(is_rising ? -1 : 1);
    const Scalar r0 = numbers_.at(end_, path_.foot), d = sign * (z_ - path_.foot);
    ExponentialFanDerivatives<Scalar> phi;
    StartMomentum<Scalar> start;  // in the orientation in which r falls
    if (path_.kind == PathKind::constant) {
      const Scalar p0 = cells_.state(path_.source, path_.foot);
      start = is_rising ? StartMomentum<Scalar>{one - p0, p0} : StartMomentum<Scalar>{p0, one - p0};
      const Scalar b = numbers_.at(end_, z_) * t_ * kappa;
      const FootRoot<Scalar> root(b, start.p);
      out_.phi_state = root.phi_by_state(b, start.p);
      phi.by_log_rate = root.phi_by_log_b(b, start.p);
      phi.by_kappa = phi.by_log_rate / kappa;
      if (cells_.is_curved(path_.source)) {
        const ExponentialRise<Scalar> rise(root, b, kappa, start.p, start.missing);
        const Scalar steep = cells_.slope(path_.source, path_.foot), all = one + rise.by_state * steep;
        const Scalar shift = -steep / all * out_.phi_state;
        out_.phi_state /= all;
        phi.by_log_rate += shift * rise.by_log_rate;
        phi.by_kappa += shift * rise.by_kappa;
      }
    } else {
      const Scalar log_E = kappa * d, e = expm1(log_E), way = r0 * t_;
      const FanMomenta<Scalar> fan(Scalar(way * kappa), log_E, e);
      start = {fan.p0, fan.one_minus_p0};
      out_.start = is_rising ? StartMomentum<Scalar>{fan.one_minus_p0, fan.p0} : start;
      phi = exponential_fan_derivatives<Scalar>(fan, kappa, way, d, e);
      out_.phi_start = phi.by_start;
    }
    out_.phi_log_scale = sign * phi.by_log_rate;
    const Scalar gain = path_.H * t_, width = pieces_.width(end_);
    const Scalar& from = path_.kind == PathKind::constant ? z_ : path_.foot;
    // log r falls by kappa times the way from the start.
    const Scalar by_kappa =
        -gain * mean_height_in_exponential<Scalar>(Scalar(r0 * t_), kappa, start.p, start.missing);
    for (const bool is_high : {false, true}) {
      const Scalar& beyond = pieces_.boundaries[is_high ? end_ : end_ + 1];
      const Scalar unit =
          Scalar(is_high ? 1 : -1) / (width * (is_high ? pieces_.high[end_] : pieces_.low[end_]));
      numbers_.number(end_, is_high).M += unit * (gain * (path_.foot - beyond) - sign * by_kappa);
      numbers_.number(end_, is_high).phi += unit * (out_.phi_log_scale * (from - beyond) - phi.by_kappa);
    }
  }

  const SlopedPieces<Scalar>& pieces_;
  const Cells<Scalar>& cells_;
  const Path<Scalar>& path_;
  std::size_t end_;
  Scalar z_, t_;
  PieceNumbers<Scalar>& numbers_;
  PathGradient<Scalar>& out_;
};

}  // namespace shearfront::exact
