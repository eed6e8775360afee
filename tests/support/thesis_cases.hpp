// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

/// The ten Riemann problems between beds of different solid fraction, L below and R above, of Table 4.1 of the
/// thesis named in docs/evidence/packing.md: f(phi) = -phi (c - phi) / c, small grains.
namespace shearfront::support {

inline double small_grains_flux(double phi, double c) { return -phi * (c - phi) / c; }
inline double least_flux(double c) { return -c / 4; }

struct ThesisCase {
  const char* name;
  double phi_l, c_l, phi_r, c_r;
  double expected;  ///< third column of the table, by hand: f(U_L), f(U_R) or one of the two minima
};

inline const std::vector<ThesisCase> kTenCases{
    {"1: waves go down, f_R > f_L", 0.2, 0.6, 0.05, 0.6, small_grains_flux(0.05, 0.6)},
    {"2: waves go down, f_Lmin <= f_R < f_L", 0.1, 0.6, 0.2, 0.7, small_grains_flux(0.2, 0.7)},
    {"3: L cannot carry f_R", 0.1, 0.4, 0.3, 0.7, least_flux(0.4)},
    {"4: both ways, L is narrower", 0.1, 0.4, 0.5, 0.7, least_flux(0.4)},
    {"5: both ways, R is narrower", 0.25, 0.7, 0.4, 0.6, least_flux(0.6)},
    {"6: both ways, R cannot carry f_L", 0.3, 0.7, 0.25, 0.3, least_flux(0.3)},
    {"7: towards each other, f_R > f_L", 0.4, 0.6, 0.05, 0.6, small_grains_flux(0.05, 0.6)},
    {"8: towards each other, f_R < f_L", 0.55, 0.6, 0.25, 0.6, small_grains_flux(0.55, 0.6)},
    {"9: waves go up, R can carry f_L", 0.55, 0.6, 0.4, 0.5, small_grains_flux(0.55, 0.6)},
    {"10: waves go up, R cannot carry f_L", 0.4, 0.7, 0.25, 0.3, least_flux(0.3)}};

}  // namespace shearfront::support
