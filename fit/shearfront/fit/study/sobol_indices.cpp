// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/study/sobol_indices.hpp"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>
#include <utility>

#include "shearfront/fit/quantile.hpp"

namespace shearfront::fit {
namespace {

constexpr int kBootstrap = 1000;

/// f(A), f(B), f(AB_j) of the base points that have all of them.
struct Triples {
  std::vector<double> a, b, mixed;
};

Triples triples_of(const std::vector<std::vector<double>>& outputs, std::size_t n, std::size_t d,
                   std::size_t j, std::size_t k) {
  Triples t;
  for (std::size_t i = 0; i < n; ++i) {
    bool is_complete = true;  // in every block, so that all entries have the same points
    for (std::size_t block = 0; block < d + 2; ++block)
      is_complete = is_complete && std::isfinite(outputs[block * n + i][k]);
    if (!is_complete) continue;
    t.a.push_back(outputs[i][k]);
    t.b.push_back(outputs[n + i][k]);
    t.mixed.push_back(outputs[(j + 2) * n + i][k]);
  }
  return t;
}

/// Both indices of the points of these numbers; about their mean, which makes products small.
std::pair<double, double> indices_of(const Triples& t, const std::vector<std::size_t>& which) {
  const auto n = static_cast<double>(which.size());
  double mean = 0;
  for (const std::size_t i : which) mean += (t.a[i] + t.b[i]) / (2 * n);
  double variance = 0, first = 0, total = 0;
  for (const std::size_t i : which) {
    const double a = t.a[i] - mean, b = t.b[i] - mean, mixed = t.mixed[i] - mean;
    variance += (a * a + b * b) / (2 * n);
    first += b * (mixed - a) / n;
    total += (a - mixed) * (a - mixed) / (2 * n);
  }
  return {first / variance, total / variance};
}

}  // namespace

std::vector<SobolIndex> sobol_indices(const std::vector<std::vector<double>>& outputs,
                                      const std::vector<std::string>& output_names,
                                      const std::vector<std::string>& entries, std::uint64_t seed) {
  std::vector<SobolIndex> all;
  const std::size_t d = entries.size(), n = outputs.size() / (d + 2);
  for (std::size_t k = 0; k < output_names.size(); ++k)
    for (std::size_t j = 0; j < d; ++j) {
      const Triples t = triples_of(outputs, n, d, j, k);
      std::vector<std::size_t> which(t.a.size());
      for (std::size_t i = 0; i < which.size(); ++i) which[i] = i;
      if (which.size() < 2) continue;
      const auto [first, total] = indices_of(t, which);
      if (!std::isfinite(first) || !std::isfinite(total)) continue;
      boost::random::mt19937_64 engine(seed);
      boost::random::uniform_int_distribution<std::size_t> any(0, t.a.size() - 1);
      std::vector<double> firsts, totals;
      for (int r = 0; r < kBootstrap; ++r) {
        for (std::size_t& i : which) i = any(engine);
        const auto [f, s] = indices_of(t, which);
        firsts.push_back(f);
        totals.push_back(s);
      }
      std::sort(firsts.begin(), firsts.end());
      std::sort(totals.begin(), totals.end());
      all.push_back({output_names[k],
                     entries[j],
                     first,
                     total,
                     {quantile(firsts, 0.025), quantile(firsts, 0.975)},
                     {quantile(totals, 0.025), quantile(totals, 0.975)}});
    }
  return all;
}

}  // namespace shearfront::fit
