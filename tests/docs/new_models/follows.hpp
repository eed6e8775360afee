// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <any>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/scene/entries.hpp"

/// What follows from its list for a model: derivatives and fits. Nothing here knows any model.
namespace shearfront::docs {

/// Three times and heights all over [0, 1], where no bed has an interface or comes to rest: central differences do not
/// see a kink in their middle.
inline std::vector<Place> places() {
  std::vector<Place> all;
  for (const double t : {0.08, 0.35, 1.1})
    for (int i = 0; i < 23; ++i) all.push_back({t, (i + 0.6180339887) / 24});
  return all;
}

/// A difference quotient of some samples, and whether it is one of a smooth function.
struct Slope {
  double by = 0;
  bool is_smooth = false;
};

/// By central differences with steps h, h/2, h/4, extrapolated twice to errors of order h^4; those of a smooth
/// function agree.
inline Slope slope(const double (&below)[3], const double (&above)[3], double h) {
  double central[3];
  for (int i = 0; i < 3; ++i) central[i] = (above[i] - below[i]) / (2 * std::ldexp(h, -i));
  const double coarse = (4 * central[1] - central[0]) / 3, fine = (4 * central[2] - central[1]) / 3;
  return {fine, std::abs(fine - coarse) < 1e-8 * (1 + std::abs(fine))};
}

/// Derivatives that the method offers, of phi and M with respect to every entry of the shear rate and of the initial state,
/// against differences of its solution.
inline bool derivatives_are_differences(const SceneSpec<double>& spec, const Method& method) {
  const Scene<double> scene(spec);
  const std::vector<Entry> all = entries(spec);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_offered = method.has_derivative(scene, all[i]);
    if (is_offered) wanted.push_back(i);
    if (!is_offered && (all[i].field.starts_with("shear_rate.") || all[i].field.starts_with("initial."))) {
      std::printf("no derivative with respect to %s\n", all[i].name().c_str());
      return false;
    }
  }
  std::any memory;
  const std::vector<Place> where = places();
  const Linearisation exact = method.linearise(scene, where, wanted, memory);
  std::size_t n_compared = 0, n_wrong = 0;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const double h = 1e-3;
    std::vector<Sample> samples[2][3];
    for (const int side : {0, 1})
      for (int i = 0; i < 3; ++i) {
        SceneSpec<double> moved = spec;
        *entry_places(moved)[wanted[k]] += (side == 0 ? -1 : 1) * std::ldexp(h, -i);
        samples[side][i] = sample(Scene<double>(moved), method, where).samples;
        if (samples[side][i].size() != where.size()) return false;
      }
    for (std::size_t p = 0; p < where.size(); ++p)
      for (const auto member : {&Sample::phi, &Sample::M}) {
        double values[2][3];
        for (const int side : {0, 1})
          for (int i = 0; i < 3; ++i) values[side][i] = samples[side][i][p].*member;
        const Slope numeric = slope(values[0], values[1], h);
        if (!numeric.is_smooth) continue;  // a shock or the edge of a fan
        ++n_compared;
        const double by = exact.derivatives[p * wanted.size() + k].*member;
        if (std::abs(by - numeric.by) <= 1e-7 * (1 + std::abs(numeric.by))) continue;
        ++n_wrong;
        std::printf("d%s/d %s = %.12g at z = %g, t = %g; by differences %.12g\n",
                    member == &Sample::phi ? "phi" : "M", all[wanted[k]].name().c_str(), by, where[p].z,
                    where[p].t, numeric.by);
      }
  }
  const std::size_t n_all = 2 * where.size() * wanted.size();
  std::printf("derivatives: %zu of %zu compared, %zu wrong\n", n_compared, n_all, n_wrong);
  return n_wrong == 0 && 2 * n_compared > n_all;
}

/// A fit to exact M that starts with the given entries `off` times too large finds them again.
inline bool is_recovered(const SceneSpec<double>& truth, std::string_view field, double off,
                         const Method& method) {
  const Scene<double> scene(truth);
  Observations data;
  data.quantity = Quantity::cumulative;
  const std::vector<Place> where = places();
  const std::vector<Sample> samples = sample(scene, method, where).samples;
  for (std::size_t p = 0; p < where.size(); ++p)
    data.rows.push_back({.t = where[p].t, .z = where[p].z, .value = samples.at(p).M});
  fit::UnknownSpec unknown;
  std::vector<double> values;
  SceneSpec<double> spec = truth;
  const std::vector<Entry> all = entries(truth);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].field.starts_with(field) && all[i].field != "shear_rate.scale") {
      unknown.parameters.push_back(all[i].name());
      values.push_back(*entry_places(spec)[i]);
      unknown.start.push_back(off * values.back());
    }
  const fit::Estimate found = fit::fit({"", scene, data, unknown, {method}, {}, {}, {}});
  bool is_good = found.usable() && !values.empty();
  for (std::size_t i = 0; i < found.parameters.size() && is_good; ++i) {
    const fit::ParameterEstimate& p = found.parameters[i];
    std::printf("fit: %s from %g to %.12g, truth %g\n", p.name.c_str(), p.start, p.estimate, values[i]);
    is_good = std::abs(p.estimate - values[i]) < 1e-6 * std::abs(values[i]);
  }
  if (!is_good) std::printf("fit: not recovered: %s\n", found.message.c_str());
  return is_good;
}

}  // namespace shearfront::docs
