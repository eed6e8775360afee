// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/one_layer_grid.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {
namespace {

template <Real S>
void sort_and_unite(std::vector<S>& xs) {
  std::sort(xs.begin(), xs.end());
  xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
}

/// States between a and b, where f is monotone, without flux: one, or none.
template <Real S>
void add_zero_between(const Flux<S>& flux, const S& a, const S& b, std::vector<S>& zeros) {
  const S at_a = flux.value(a), at_b = flux.value(b);
  if (at_a == 0) zeros.push_back(a);
  if (at_b == 0) zeros.push_back(b);
  if (!(at_a < 0 && at_b > 0) && !(at_a > 0 && at_b < 0)) return;
  std::uintmax_t most = 200;
  const boost::math::tools::eps_tolerance<S> tolerance(std::numeric_limits<S>::digits);
  const auto [lo, hi] = boost::math::tools::toms748_solve([&](const S& x) { return S(flux.value(x)); }, a, b,
                                                          at_a, at_b, tolerance, most);
  zeros.push_back(lo + (hi - lo) / S(2));
}

/// Ends, extrema, zeros and wanted states, and equal steps between them.
template <Real S>
std::vector<S> with_steps(const std::vector<S>& special, const S& largest) {
  using std::ceil;
  std::vector<S> all;
  for (std::size_t i = 0; i + 1 < special.size(); ++i) {
    const S &lo = special[i], &hi = special[i + 1];
    const S shy = S(1) - S(1e-9);  // a step that is all but the largest one is whole
    const auto n = static_cast<std::uint64_t>(to_double(S(ceil(S(shy * (hi - lo) / largest)))));
    all.push_back(lo);
    for (std::uint64_t k = 1; k < n; ++k) {
      const S x = lo + (hi - lo) * (S(static_cast<double>(k)) / S(static_cast<double>(n)));
      if (x > all.back() && x < hi) all.push_back(x);
    }
  }
  all.push_back(special.back());
  return all;
}

}  // namespace

template <Real S>
std::string OneLayerGrid<S>::refusal(const LayerStack<S>& stack, const S& resolution) {
  constexpr double kMostStates = 1e8;
  if (stack.n_layers() != 1)
    return "flux " + std::string(stack.fluxes().front().name()) +
           " has several extrema, which are covered in a bed of one layer only";
  if (1 / to_double(resolution) > kMostStates)
    return "the grid would need too many states; use a coarser resolution";
  return {};
}

template <Real S>
typename OneLayerGrid<S>::Built OneLayerGrid<S>::exact_levels(const LayerStack<S>& stack, const S& resolution,
                                                              const std::vector<LayerState<S>>& wanted) {
  SHEARFRONT_EXPECTS(resolution > 0 && resolution <= 1 && stack.n_layers() == 1, "a grid of one layer");
  Built built;
  OneLayerGrid& grid = built.grid;
  grid.boundaries_ = stack.boundaries();
  grid.flux_ = stack.flux(0);
  grid.rate_ = stack.rate(0);
  grid.solid_fraction_ = stack.solid_fraction(0);
  const Flux<S>& flux = grid.flux_;
  const StateRange<S> range = flux.range();
  const std::vector<S> extrema = flux.extrema();

  std::vector<S> special = extrema, zeros;
  special.push_back(range.lowest);
  special.push_back(range.highest);
  sort_and_unite(special);
  for (std::size_t i = 0; i + 1 < special.size(); ++i)
    add_zero_between(flux, special[i], special[i + 1], zeros);
  sort_and_unite(zeros);
  special.insert(special.end(), zeros.begin(), zeros.end());
  for (const LayerState<S>& state : wanted) special.push_back(state.phi);
  sort_and_unite(special);
  std::vector<S> shares = with_steps(special, S(resolution * (range.highest - range.lowest)));

  const auto state_of = [&](const S& share) {
    return static_cast<State>(std::lower_bound(shares.begin(), shares.end(), share) - shares.begin());
  };
  for (const S& share : extrema) grid.extrema_.push_back(state_of(share));
  for (const S& share : zeros) grid.zeros_.push_back(state_of(share));
  for (const LayerState<S>& state : wanted) built.states.push_back(state_of(state.phi));
  const S strength = grid.rate_ * grid.solid_fraction_;
  for (const S& share : shares) grid.fluxes_.push_back(strength * flux.value(share));
  for (const State i : grid.zeros_) grid.fluxes_[static_cast<std::size_t>(i)] = S(0);

  std::vector<S> values = grid.fluxes_;
  sort_and_unite(values);
  const auto rank_of = [&](const S& value) {
    return static_cast<State>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
  };
  for (const S& value : grid.fluxes_) grid.ranks_.push_back(rank_of(value));
  if (!grid.zeros_.empty()) grid.zero_rank_ = rank_of(S(0));
  const auto last = static_cast<State>(shares.size()) - 1;
  grid.polygon_ = {flux, std::move(shares), 0, last, false};
  grid.fastest_ = grid.rate_ * grid.polygon_.steepest();
  return built;
}

template class OneLayerGrid<Instantiated>;

}  // namespace shearfront
