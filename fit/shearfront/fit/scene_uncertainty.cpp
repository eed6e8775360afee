// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/scene_uncertainty.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/detail/toml_source.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/scene/entries.hpp"

namespace shearfront::fit {
namespace {

using detail::ComplaintReport;
using detail::Position;
using detail::TextSource;
using detail::TomlSource;

constexpr std::string_view kTable = "uncertain", kFile = "covariance";

/// Where the entries of a scene with this name stand: one, or all of an array; none for any other name.
std::vector<std::size_t> places_named(const std::vector<Entry>& all, std::string_view name) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].field == name || all[i].name() == name) places.push_back(i);
  return places;
}

std::string unknown_name(const std::vector<Entry>& all, const std::string& name) {
  std::vector<std::string> names;
  for (const Entry& entry : all) names.push_back(entry.field);
  const auto meant = nearest_name(name, names);
  return "must be a number of the scene, such as " + all.front().name() +
         (meant ? " (did you mean " + *meant + "?)" : "");
}

class UncertaintyReader {
 public:
  UncertaintyReader(const TomlSource& source, const Scene<double>& scene)
      : source_(source), report_(source.name()), entries_(entries(scene.spec())) {
    SceneSpec<double> spec = scene.spec();
    for (const double* place : entry_places(spec)) values_.push_back(*place);
  }

  std::optional<SceneUncertainty> read() {
    const toml::node* node = source_.root().get(kTable);
    if (!node) return std::nullopt;
    const toml::table& table = *node->as_table();
    std::optional<SceneUncertainty> result;
    if (const toml::node* file = table.get(kFile)) {
      if (table.size() > 1)
        add(*file, std::string(kFile), "must stand alone: it says what is uncertain");
      else if (!file->is_string())
        add(*file, std::string(kFile), "must be the name of a CSV file");
      else
        result = covariance_from(*file);
    } else {
      deviations(table, "");
      result = independent();
    }
    if (report_.is_empty() && result->entries.empty())
      report_.add(TomlSource::position(*node), {std::string(kTable), "", "must name entries of the scene"});
    report_.throw_if_any();
    return result;
  }

 private:
  void add(const toml::node& node, const std::string& key, std::string constraint) {
    report_.add(TomlSource::position(node),
                {std::string(kTable) + "." + key, source_.shown(node), std::move(constraint)});
  }

  void deviations(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      if (const toml::table* inner = node.as_table())
        deviations(*inner, name + ".");
      else
        deviation(name, node);
    }
  }

  void deviation(const std::string& name, const toml::node& node) {
    const std::vector<std::size_t> places = places_named(entries_, name);
    if (places.empty()) return add(node, name, unknown_name(entries_, name));
    std::vector<double> relative;
    if (const toml::array* array = node.as_array())
      for (const toml::node& element : *array) relative.push_back(element.value<double>().value_or(NAN));
    else
      relative.assign(places.size(), node.value<double>().value_or(NAN));
    if (relative.size() != places.size())
      return add(node, name, fmt::format("must be one number, or one for each of its {}", places.size()));
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!(relative[i] > 0 && std::isfinite(relative[i])))
        return add(node, name, "must be a relative standard deviation > 0");
      if (values_[places[i]] == 0)
        return add(node, name,
                   fmt::format("must not be relative to {} = 0; use a file of covariances",
                               entries_[places[i]].name()));
      if (std::find(places_.begin(), places_.end(), places[i]) != places_.end())
        return add(node, name, "must not name an entry twice");
      places_.push_back(places[i]);
      deviations_.push_back(relative[i] * std::abs(values_[places[i]]));
    }
  }

  [[nodiscard]] SceneUncertainty independent() const {
    SceneUncertainty result;
    for (const std::size_t place : places_) result.entries.push_back(entries_[place].name());
    const Eigen::Map<const Eigen::VectorXd> sd(deviations_.data(),
                                               static_cast<Eigen::Index>(deviations_.size()));
    result.covariance = sd.array().square().matrix().asDiagonal();
    return result;
  }

  std::optional<SceneUncertainty> covariance_from(const toml::node& node) {
    const auto path =
        (std::filesystem::path(source_.name()).parent_path() / node.as_string()->get()).string();
    try {
      return covariance_in(TextSource::read(path));
    } catch (const FileError& error) {
      if (error.complaints().front().kind != Complaint::Kind::unreadable) throw;
      add(node, std::string(kFile), error.complaints().front().constraint);
      return std::nullopt;
    }
  }

  SceneUncertainty covariance_in(const TextSource& file) const {
    ComplaintReport report(file.name());
    SceneUncertainty result;
    const std::vector<std::size_t> lines = detail::lines_of_content(file.text());
    std::vector<detail::CsvField> fields;
    if (!lines.empty()) (void)detail::split_csv(detail::line_at(file.text(), lines[0]), fields);
    for (const detail::CsvField& field : fields) {
      const std::string name(field.text);
      const bool is_known =
          std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name() == name; });
      if (!is_known)
        report.add(file.position(lines[0] + field.offset),
                   {"header", quoted_text(name), unknown_name(entries_, name)});
      else if (std::find(result.entries.begin(), result.entries.end(), name) != result.entries.end())
        report.add(file.position(lines[0] + field.offset),
                   {"header", quoted_text(name), "must not occur twice"});
      result.entries.push_back(name);
    }
    const std::size_t n = result.entries.size();
    result.covariance = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
    if (lines.size() != n + 1 || n == 0)
      report.add({1, 1}, {"rows", fmt::format("({})", lines.empty() ? 0 : lines.size() - 1),
                          "must be as many as columns, below a header with the names of entries"});
    for (std::size_t i = 0; i < n && i + 1 < lines.size(); ++i) {
      (void)detail::split_csv(detail::line_at(file.text(), lines[i + 1]), fields);
      for (std::size_t j = 0; j < n; ++j) {
        const auto number = j < fields.size() ? parse_number(fields[j].text) : std::nullopt;
        if (!number || fields.size() != n) {
          report.add(file.position(lines[i + 1]),
                     {fmt::format("row[{}]", i), "", fmt::format("must have {} numbers", n)});
          break;
        }
        result.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = *number;
      }
    }
    report.throw_if_any();
    check_matrix(result.covariance, report);
    report.throw_if_any();
    return result;
  }

  /// Symmetric up to the digits it was printed with, no negative variance in any direction.
  static void check_matrix(Eigen::MatrixXd& matrix, ComplaintReport& report) {
    constexpr double kPrinted = 1e-6;
    const Eigen::VectorXd sd = matrix.diagonal().cwiseMax(0).cwiseSqrt();
    const auto refuse = [&](const char* constraint) { report.add({1, 1}, {"covariance", "", constraint}); };
    if (!(sd.minCoeff() > 0)) return refuse("must have a positive diagonal");
    const Eigen::MatrixXd correlation =
        sd.cwiseInverse().asDiagonal() * matrix * sd.cwiseInverse().asDiagonal();
    if (!((correlation - correlation.transpose()).cwiseAbs().maxCoeff() < kPrinted))
      return refuse("must be symmetric");
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(correlation, Eigen::EigenvaluesOnly);
    if (solver.eigenvalues().minCoeff() < -kPrinted) return refuse("must not have negative eigenvalues");
    matrix = (matrix + matrix.transpose()) / 2;
  }

  const TomlSource& source_;
  ComplaintReport report_;
  std::vector<Entry> entries_;
  std::vector<double> values_;       ///< of all entries
  std::vector<std::size_t> places_;  ///< of the uncertain ones
  std::vector<double> deviations_;
};

}  // namespace

std::optional<SceneUncertainty> read_uncertainty(const std::string& text, const std::string& path,
                                                 const Scene<double>& scene) {
  const TomlSource source(TextSource(path, text));
  return UncertaintyReader(source, scene).read();
}

DrawnScenes draw_scenes(const Scene<double>& scene, const SceneUncertainty& uncertainty, std::size_t n,
                        std::uint64_t seed) {
  UnknownSpec unknown;
  unknown.parameters = uncertainty.entries;
  const Parameters parameters(scene, unknown);
  Estimate known;  // as a fit would have found the numbers of the scene
  known.sigma_is_given = true;
  const Eigen::VectorXd sd = uncertainty.covariance.diagonal().cwiseSqrt();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    ParameterEstimate& p = known.parameters.emplace_back();
    p.name = parameters[i].name();
    p.estimate = parameters[i].start;
    p.std_error = sd[static_cast<Eigen::Index>(i)];
  }
  known.correlation =
      sd.cwiseInverse().asDiagonal() * uncertainty.covariance * sd.cwiseInverse().asDiagonal();
  return draw_scenes(parameters, known, n, seed);
}

}  // namespace shearfront::fit
