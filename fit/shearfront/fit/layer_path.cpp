// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/layer_path.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/misfit_rows.hpp"
#include "shearfront/fit/model_choice.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/fit/staged_search.hpp"
#include "shearfront/model/depth/all.hpp"

namespace shearfront::fit {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

constexpr std::size_t kLayerParts = 4;  // of a layer, between which it may be split
constexpr std::size_t kMostSplits = 3;  // that are tried for one more layer
constexpr std::size_t kMostJoints = 2;  // for one fewer
constexpr double kThinnest = 1e-4;      // of the bed: what is thinner is not split
constexpr double kWidestStep = 1;       // of the logarithm of a rate

struct Layers {
  std::vector<double> breaks, values;
};

template <class Visit>
void for_each_array(auto& function, const Visit& visit) {
  std::visit(
      [&](auto& model) {
        model.fields(model, [&](const FieldInfo& info, auto& member) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(member)>, double>)
            visit(info.measure == Measure::height, member);
        });
      },
      function);
}
Layers layers_of(const Scene<double>& scene) {
  Layers layers;
  for_each_array(scene.shear_rate(), [&](bool are_breaks, const auto& numbers) {
    (are_breaks ? layers.breaks : layers.values) = numbers;
  });
  return layers;
}
/// Nothing if it is no scene.
std::optional<Scene<double>> scene_of(const Scene<double>& scene, const Layers& layers) {
  SceneSpec<double> spec = scene.spec();
  DepthFunctionList<double>::for_each([&]<class Model>() {
    if (Model::kIsLayered && Model::kName == layered_name()) spec.shear_rate = Model{};
  });
  for_each_array(spec.shear_rate, [&](bool are_breaks, auto& numbers) {
    numbers = are_breaks ? layers.breaks : layers.values;
  });
  auto made = Scene<double>::make(std::move(spec));
  if (!std::holds_alternative<Scene<double>>(made)) return std::nullopt;
  return std::get<Scene<double>>(std::move(made));
}

struct Linear {
  VectorXd residuals;
  MatrixXd jacobian;
};
Linear linear_at_start(const FitSpec& spec) {
  const Parameters parameters(spec.scene, spec.unknown);
  const ResidualRows rows = rows_of(quantity_of(spec), spec, parameters);
  const Forward forward(parameters, spec.forward, rows.field, rows.points);
  const auto at = forward.predict(parameters.start(), true);
  if (!at.is_valid()) return {};
  return {rows.residuals(at.values), rows.jacobian(at.derivatives)};
}

class LayerPath {
 public:
  LayerPath(const FitSpec& base, const ModelChoice& choice, const Progress& progress)
      : base_(base), choice_(choice), progress_(progress) {}

  std::map<std::size_t, FitSpec> run(std::size_t most) {
    for (std::size_t n = 1; n <= most && !is_over_; ++n) {
      take(n, with_model(base_, choice_, {layered_name(), n, {}}, base_.scene));
      if (n > 1 && best_.contains(n - 1))
        for (const Layers& layers : splits(best_.at(n - 1))) take(n, layers);
    }
    for (std::size_t n = most; n > 2 && !is_over_; --n)
      if (best_.contains(n))
        for (const Layers& layers : joints(layers_of(best_.at(n).scene))) take(n - 1, layers);
    std::map<std::size_t, FitSpec> starts;
    for (auto& [n, trial] : best_) starts.emplace(n, std::move(trial.spec));
    return starts;
  }

 private:
  struct Trial {
    FitSpec spec;  ///< that starts where the search has ended
    Scene<double> scene;
    double misfit;
  };

  /// Searches from these layers, at once for the misfit asked for: they are near what is looked for.
  void take(std::size_t n, const Layers& layers) {
    const auto scene = scene_of(base_.scene, layers);
    if (!scene) return;
    FitSpec spec = with_model(base_, choice_, {layered_name(), n, {}}, *scene, layers.breaks);
    spec.misfit.two_stage = false;
    take(n, std::move(spec));
  }
  void take(std::size_t n, FitSpec spec) {
    if (is_over_) return;
    StagedSearch search(spec, progress_);
    search.find();
    is_over_ = search.must_stop() && search.result().status == Status::interrupted;
    const auto values = search.values();
    if (!values) return;
    std::string failure;
    auto scene = search.parameters().scene_at(*values, failure);
    const double misfit = search.result().misfit;
    const auto known = best_.find(n);
    if (!scene || (known != best_.end() && !(misfit < known->second.misfit))) return;
    spec.unknown.start.assign(values->begin(), values->end());
    spec.misfit.two_stage = false;
    best_.insert_or_assign(n, Trial{std::move(spec), *std::move(scene), misfit});
  }

  /// The most promising, one of each layer at most.
  [[nodiscard]] std::vector<Layers> splits(const Trial& from) const {
    const Layers coarse = layers_of(from.scene);
    const double bottom = from.scene.bottom(), height = from.scene.top() - bottom;
    Layers fine;
    std::vector<std::size_t> first;  // part of each layer
    const auto end = [&](std::size_t i) {
      return i == 0 ? bottom : i > coarse.breaks.size() ? from.scene.top() : coarse.breaks[i - 1];
    };
    for (std::size_t i = 0; i < coarse.values.size(); ++i) {
      first.push_back(fine.values.size());
      const double lo = end(i), width = end(i + 1) - lo;
      const std::size_t parts = width > kThinnest * height ? kLayerParts : 1;
      for (std::size_t k = 0; k < parts; ++k) {
        if (i + k > 0)
          fine.breaks.push_back(lo + width * static_cast<double>(k) / static_cast<double>(parts));
        fine.values.push_back(coarse.values[i]);
      }
    }
    first.push_back(fine.values.size());
    const auto fine_scene = scene_of(from.scene, fine);
    if (!fine_scene) return {};
    const Linear at = linear_at_start(from.spec);
    const Linear parts = linear_at_start(
        with_model(base_, choice_, {layered_name(), fine.values.size(), fine.breaks}, *fine_scene));
    if (at.residuals.size() == 0 || parts.residuals.size() == 0) return {};
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(at.jacobian);
    const MatrixXd basis =
        qr.householderQ() * MatrixXd::Identity(at.jacobian.rows(), std::min(qr.rank(), at.jacobian.cols()));

    std::vector<std::pair<double, Layers>> all;
    for (std::size_t i = 0; i < coarse.values.size(); ++i) {
      double most = 0;
      VectorXd column = VectorXd::Zero(at.residuals.size());
      for (std::size_t k = first[i]; k + 1 < first[i + 1]; ++k) {
        column += parts.jacobian.col(static_cast<Eigen::Index>(k)) * coarse.values[i];
        const VectorXd normal = column - basis * (basis.transpose() * column);
        const double size = normal.squaredNorm(), slope = at.residuals.dot(normal);
        const double gain = slope * slope / size;
        if (!(gain > most)) continue;
        if (most > 0) all.pop_back();
        most = gain;
        const double step = std::clamp(-slope / size, -kWidestStep, kWidestStep),
                     share = static_cast<double>(k + 1 - first[i]) / kLayerParts;
        Layers split = coarse;
        const auto place = static_cast<std::ptrdiff_t>(i);
        split.breaks.insert(split.breaks.begin() + place, fine.breaks[k]);
        split.values[i] *= std::exp(-step * share);
        split.values.insert(split.values.begin() + place, coarse.values[i] * std::exp(step * (1 - share)));
        all.emplace_back(gain, std::move(split));
      }
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Layers> best;
    for (auto& [gain, layers] : all)
      if (best.size() < kMostSplits) best.push_back(std::move(layers));
    return best;
  }

  /// Of neighbours that differ least: by the logarithm of their rates, and how thick both are.
  [[nodiscard]] std::vector<Layers> joints(const Layers& from) const {
    const auto end = [&](std::size_t i) {
      return i == 0 ? base_.scene.bottom() : i > from.breaks.size() ? base_.scene.top() : from.breaks[i - 1];
    };
    std::vector<std::pair<double, Layers>> all;
    for (std::size_t i = 0; i + 1 < from.values.size(); ++i) {
      const double low = end(i + 1) - end(i), high = end(i + 2) - end(i + 1), both = low + high;
      const double d = std::log(from.values[i + 1] / from.values[i]);
      Layers joined = from;
      const auto place = static_cast<std::ptrdiff_t>(i);
      joined.values[i] =
          both > 0 ? both / (low / from.values[i] + high / from.values[i + 1]) : from.values[i];
      joined.values.erase(joined.values.begin() + place + 1);
      joined.breaks.erase(joined.breaks.begin() + place);
      all.emplace_back(both > 0 ? d * d * low * high / both : 0.0, std::move(joined));
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Layers> best;
    for (auto& [cost, layers] : all)
      if (best.size() < kMostJoints) best.push_back(std::move(layers));
    return best;
  }

  const FitSpec& base_;
  const ModelChoice& choice_;
  const Progress& progress_;
  std::map<std::size_t, Trial> best_;
  bool is_over_ = false;
};

}  // namespace

std::map<std::size_t, FitSpec> layer_path(const FitSpec& base, const ModelChoice& choice, std::size_t most,
                                          const Progress& progress) {
  return LayerPath(base, choice, progress).run(most);
}

bool has_layer_path(const FitSpec& base, const ModelChoice& choice) {
  const FitSpec spec = with_model(base, choice, {layered_name(), 2, {}}, base.scene);
  const Parameters parameters(spec.scene, spec.unknown);
  const ResidualRows rows = rows_of(quantity_of(spec), spec, parameters);
  return Forward(parameters, spec.forward, rows.field, rows.points).has_derivatives();
}

}  // namespace shearfront::fit
