// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/misfit_rows.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/loss/all.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::fit {

ResidualRows with_unit(ResidualRows rows, const FitSpec& spec, const Parameters& parameters) {
  const Quantity measured = spec.observations.quantity;
  const bool is_height = measured == Quantity::bed_height, is_sum = measured == Quantity::cumulative;
  if (!spec.observations.has_sigma())
    rows.unit = (is_height || is_sum ? parameters.height() : 1) * (is_height ? 1 : parameters.states());
  // Bins are means over z, whatever passes.
  if (spec.scene.is_chute() && measured == Quantity::bin && rows.field == Observable::M)
    rows.field = Observable::volume;
  return rows;
}

ResidualRows rows_of(std::string_view quantity, const FitSpec& spec, const Parameters& parameters) {
  ResidualRows rows;
  std::string refusal;
  if (!MisfitList::contains(quantity))
    throw InputError("misfit.quantity", quoted_text(quantity), "must be one of: " + MisfitList::names());
  MisfitList::for_each([&]<class M>() {
    if (quantity != M::kName) return;
    refusal = M::refusal(spec.observations);
    // There M is what passes below z, not an integral of phi over z alone.
    const Quantity measured = spec.observations.quantity;
    if (spec.scene.is_chute() && measured != Quantity::bin && quantity != name_of(measured))
      refusal = "in a steady chute phi at points and M must be compared as such: misfit.quantity = " +
                quoted_text(name_of(measured));
    if (refusal.empty()) rows = M::rows(spec.observations, spec.scene.bottom(), spec.scene.top());
  });
  if (!refusal.empty()) throw InputError("misfit.quantity", quoted_text(quantity), refusal);
  return with_unit(std::move(rows), spec, parameters);
}

std::shared_ptr<const NoisePlaces> noise_places(const FitSpec& spec, const ResidualRows& rows) {
  std::vector<Observation> measured;
  for (std::size_t i = 0; i < rows.rows.size(); ++i)
    measured.push_back(spec.observations.rows[rows.data(i).front().index]);
  return std::make_shared<NoisePlaces>(measured, spec.noise.model == NoiseModel::discrepancy);
}

std::string noise_refusal(const FitSpec& spec, const ResidualRows& rows) {
  if (!rows.are_single())
    return fmt::format("needs data compared as what they are: misfit.quantity must be {}",
                       quoted_text(name_of(spec.observations.quantity)));
  if (quantity_of(spec) == PointMisfit::kName && !spec.scene.has_diffusion())
    return "needs a misfit without steps: points near shocks have them; measure means over bins";
  if (find_loss(loss_of(spec), 0).is_robust)
    return "needs misfit.loss = \"squared\": whitened residuals are no single errors";
  if (spec.noise.tau && !spec.observations.has_sigma())
    return "needs the sigma of the data beside noise.tau: without it only their ratio is known";
  return noise_places(spec, rows)->refusal();
}

void set_size(ResidualRows& rows, double size) {
  for (ResidualRows::Row& row : rows.rows) row.weight = 1 / size;
  rows.unit = 1;
}

double mean_spacing(const Observations& observations) {
  double sum = 0;
  std::size_t n = 0;
  for (const MeasuredProfile& profile : measured_profiles(observations)) {
    sum += observations.rows[profile.rows.back()].z - observations.rows[profile.rows.front()].z;
    n += profile.rows.size() - 1;
  }
  return n > 0 ? sum / static_cast<double>(n) : 1;
}

std::string_view quantity_of(const FitSpec& spec) {
  if (spec.misfit.quantity.empty()) return name_of(spec.observations.quantity);
  return spec.misfit.quantity;
}

std::string_view loss_of(const FitSpec& spec) {
  if (!spec.misfit.loss.empty()) return spec.misfit.loss;
  return quantity_of(spec) == PointMisfit::kName ? HuberLoss::kName : SquaredLoss::kName;
}

}  // namespace shearfront::fit
