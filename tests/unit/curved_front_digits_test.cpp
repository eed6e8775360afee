// SPDX-License-Identifier: BSD-3-Clause
// When a curved front is where, against its closed form in 50 digits: how many digits are lost, case by case.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "shearfront/track/curved_front.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using FrontDigits = boost::multiprecision::cpp_bin_float_50;

/// int q dz from a to b as its closed form stands in a book, for a level that lives at both.
FrontDigits book_area(const RatePiece& piece, double h, double a, double b) {
  const auto primitive = [&](double height) {
    const FrontDigits z = FrontDigits(height) - FrontDigits(piece.z_low);
    const FrontDigits r = piece.curve == RateCurve::linear
                              ? FrontDigits(piece.low) + FrontDigits(piece.bend) * z
                              : FrontDigits(piece.low) * exp(FrontDigits(piece.bend) * z);
    if (h == 0) return FrontDigits(height) * piece.bend;
    const FrontDigits q = sqrt(1 - FrontDigits(h) / r), artanh = log((1 + q) / (1 - q)) / 2;
    return piece.curve == RateCurve::linear ? FrontDigits(r * q - FrontDigits(h) * artanh)
                                            : FrontDigits(2 * (artanh - q));
  };
  return (primitive(b) - primitive(a)) / FrontDigits(piece.bend);
}

struct LostDigits {
  double worst = 0, sum = 0;
  int n = 0;
};

/// Relative error of t - t0 for fronts whose levels differ by the part `spread` of their capacity, from far below the rate up to
/// `share` of the least one, on ways of `way`; roundings of 2^-53.
LostDigits lost_digits(RateCurve curve, double share, double spread, double way, bool same_side) {
  support::SceneMaker maker(support::seed_of(17));
  LostDigits lost;
  for (int i = 0; i < 400; ++i) {
    const double low = maker.uniform(0.5, 2), high = low * maker.uniform(1.1, 4);
    const RatePiece piece =
        maker.integer(0, 1) == 0 ? RatePiece(0, 1, low, high, curve) : RatePiece(0, 1, high, low, curve);
    const double least = std::min(piece.low, piece.high);
    const double h = least * share * maker.uniform(0.2, 1), other = h * (1 - spread);
    const LevelCurves grid({piece}, {0, other, h}, {});
    CurvedNode f;
    const bool is_high = maker.integer(0, 1) == 1;
    f.below = is_high ? grid.high(1) : grid.low(1);
    f.above = is_high == same_side ? grid.high(2) : grid.low(2);
    if (maker.integer(0, 1) == 0) std::swap(f.below, f.above);
    const double z = maker.uniform(0.3, 0.6);
    set_course(grid, f, z, 0);
    const double end = z + f.direction * way * maker.uniform(0.5, 1);
    const double h_below = grid.capacity(grid.level(f.below)), h_above = grid.capacity(grid.level(f.above));
    const FrontDigits exact = 2 *
                              (grid.sign(f.above) * book_area(piece, h_above, z, end) -
                               grid.sign(f.below) * book_area(piece, h_below, z, end)) /
                              (FrontDigits(h_below) - FrontDigits(h_above));
    const double error = std::abs(static_cast<double>((passage(grid, f, end).t - exact) / exact)) * 0x1p53;
    lost.worst = std::max(lost.worst, error);
    lost.sum += error;
    ++lost.n;
  }
  return lost;
}

TEST(CurvedFrontDigits, FewAreLost) {
  struct Case {
    const char* name;
    double share, spread, way;
    bool same_side;
    double worst[2];  ///< roundings, of linear and exponential pieces
  };
  const Case cases[] = {{"levels of a coarse grid", 0.8, 0.1, 0.3, true, {100, 100}},
                        {"levels of a fine grid", 0.8, 1e-3, 0.3, true, {16, 16}},
                        {"levels 1e-6 apart", 0.8, 1e-6, 0.3, true, {16, 16}},
                        {"levels 1e-9 apart", 0.8, 1e-9, 0.3, true, {16, 16}},
                        {"far below the rate", 1e-9, 0.1, 0.3, true, {16, 16}},
                        {"short ways", 0.8, 0.1, 1e-6, true, {100, 100}},
                        {"short ways far below the rate", 1e-9, 0.1, 1e-6, true, {16, 16}},
                        {"shocks across the maximum", 0.8, 0.1, 0.3, false, {16, 16}}};
  for (const Case& c : cases)
    for (const RateCurve curve : {RateCurve::linear, RateCurve::exponential}) {
      const bool is_linear = curve == RateCurve::linear;
      const LostDigits lost = lost_digits(curve, c.share, c.spread, c.way, c.same_side);
      std::printf("%-32s %-12s mean %8.2g, worst %8.2g roundings\n", c.name,
                  is_linear ? "linear" : "exponential", lost.sum / lost.n, lost.worst);
      EXPECT_LE(lost.worst, c.worst[is_linear ? 0 : 1]) << c.name;
      EXPECT_GT(lost.sum, 0) << c.name;
    }
}

}  // namespace
}  // namespace shearfront
