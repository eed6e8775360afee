// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/medium.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "shearfront/exact/canonical_form.hpp"
#include "shearfront/exact/layered_medium.hpp"
#include "shearfront/exact/root_medium.hpp"
#include "shearfront/exact/scaled_medium.hpp"
#include "shearfront/exact/sloped_medium.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

namespace {

/// The knots of a smooth start, and heights between them: of the form's number of parts of the bed.
template <Real Scalar>
std::vector<Scalar> finer_cuts(const CanonicalForm<Scalar>& form) {
  const Scalar &bottom = form.boundaries().front(), &top = form.boundaries().back();
  std::vector<Scalar> ends = form.start()->knots(), cuts;
  ends.push_back(top);
  Scalar from = bottom;
  for (const Scalar& to : ends) {
    const double share = to_double(Scalar((to - from) / (top - bottom)));
    const int n =
        std::max(1, static_cast<int>(std::ceil(share * static_cast<double>(form.n_start_parts()) - 1e-9)));
    for (int i = 1; i < n; ++i) {
      const Scalar y = from + (to - from) * (Scalar(i) / Scalar(n));
      if (y > (cuts.empty() ? bottom : cuts.back()) && y < to) cuts.push_back(y);
    }
    if (to < top) cuts.push_back(to);
    from = to;
  }
  return cuts;
}

/// Where a smooth start rises through the peak of a flux with a kink: in a flat piece a fan of speeds leaves there.
template <Real Scalar>
std::vector<Scalar> still_heights(const Cells<Scalar>& cells, const PieceFluxes<Scalar>& fluxes) {
  std::vector<Scalar> heights;
  for (std::size_t i = 0; i < cells.n_cells(); ++i) {
    const std::size_t k = cells.layer[i];
    const Scalar& peak = fluxes.flux(k).peak();
    if (!fluxes.flux(k).has_kink() || !(cells.phi[i] < cells.phi_high[i])) continue;
    if (cells.phi[i] < peak && cells.phi_high[i] > peak) heights.push_back(cells.height_of_state(i, peak));
    if (cells.phi[i] == peak) heights.push_back(cells.x[i]);
    if (cells.phi_high[i] == peak) heights.push_back(cells.x[i + 1]);
  }
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

template <Real Scalar>
Cells<Scalar> constant_cells(const CanonicalForm<Scalar>& form) {
  return {form.initial_breaks(), form.initial_values(), form.boundaries()};
}
/// In parts; `fluxes`, null for parabolas, get to know the heights that stand still.
template <Real Scalar>
Cells<Scalar> smooth_cells(const CanonicalForm<Scalar>& form, PieceFluxes<Scalar>* fluxes) {
  std::vector<Scalar> cuts = finer_cuts(form);
  Cells<Scalar> cells(form.start(), cuts, form.boundaries());
  if (!fluxes) return cells;
  fluxes->still = still_heights(cells, *fluxes);
  if (fluxes->still.empty()) return cells;
  const auto middle = cuts.insert(cuts.end(), fluxes->still.begin(), fluxes->still.end());
  std::inplace_merge(cuts.begin(), middle, cuts.end());
  return {form.start(), cuts, form.boundaries()};
}

/// In the unit of time in which its fastest rate is about 1: closed forms multiply rates and take their roots, and results must not depend
/// on the unit of the user's times.
template <Real Scalar>
std::shared_ptr<const Medium<Scalar>> medium_of_pieces(const CanonicalForm<Scalar>& form) {
  std::vector<Scalar> low = form.low_rates(), high = form.high_rates();
  const Scalar fastest =
      std::max(*std::max_element(low.begin(), low.end()), *std::max_element(high.begin(), high.end()));
  const Scalar unit(std::ldexp(1.0, std::ilogb(to_double(fastest))));
  for (auto* rates : {&low, &high})
    for (Scalar& r : *rates) r /= unit;
  if (form.rate_forms().front() == RateForm::root) {
    auto root =
        std::make_unique<const RootMedium<Scalar>>(low[0], high[0], constant_cells(form), form.mass());
    if (unit == Scalar(1)) return root;
    return std::make_shared<const ScaledMedium<Scalar>>(std::move(root), unit);
  }
  SlopedPieces<Scalar> pieces(form.boundaries(), std::move(low), std::move(high), form.rate_forms());
  const auto fluxes = form.is_parabolic() ? nullptr : std::make_shared<PieceFluxes<Scalar>>(fluxes_of(form));
  Cells<Scalar> cells = form.start() ? smooth_cells(form, fluxes.get()) : constant_cells(form);
  auto medium =
      std::make_unique<const SlopedMedium<Scalar>>(std::move(pieces), std::move(cells), form.mass(), fluxes);
  if (unit == Scalar(1)) return medium;
  return std::make_shared<const ScaledMedium<Scalar>>(std::move(medium), unit);
}

}  // namespace

template <Real Scalar>
std::shared_ptr<const Medium<Scalar>> make_medium(const CanonicalForm<Scalar>& form) {
  if (form.has_pieces()) return medium_of_pieces(form);
  const auto layered = [&]<class Law>(Law law) -> std::shared_ptr<const Medium<Scalar>> {
    Cells<Scalar> cells = form.start() ? Cells<Scalar>(form.start(), form.start()->knots(), form.boundaries())
                                       : constant_cells(form);
    return std::make_shared<const LayeredMedium<Scalar, Law>>(std::move(law), std::move(cells), form.mass());
  };
  if (form.is_parabolic()) return layered(ParabolaLaw<Scalar>(form.boundaries(), form.rates()));
  return layered(unimodal_law(form));
}

template class Medium<Instantiated>;
template std::shared_ptr<const Medium<Instantiated>> make_medium(const CanonicalForm<Instantiated>&);

}  // namespace shearfront::exact
