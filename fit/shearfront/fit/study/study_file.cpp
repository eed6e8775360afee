// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "shearfront/fit/method_table.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/fit/study/study_spec.hpp"
#include "shearfront/io/detail/toml_source.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/scene_text.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/scene/entries.hpp"

namespace shearfront::fit {
namespace {

using detail::ComplaintReport;
using detail::TableReader;
using detail::TomlSource;
using Need = TableReader::Need;
using Kind = StudyOutput::Kind;

constexpr unsigned long long kMostStudyRuns = 100'000'000;
constexpr std::size_t kMostGridRuns = 100'000'000;

class StudyReader {
 public:
  StudyReader(const TomlSource& source, SceneChanges changes)
      : source_(source), report_(source.name()), changes_(std::move(changes)) {}

  StudySpec read() {
    TableReader root(source_, report_, "", source_.root());
    spec_.name = root.text("name", Need::optional, "must be text")
                     .value_or(std::filesystem::path(source_.name()).stem().string());
    scene(root);
    for (TableReader& table :
         root.tables("vary", Need::optional, "must be tables with entry and how it varies"))
      variation(table);
    if (auto table = root.table("design", Need::optional, "must be a table with kind and runs"))
      design(*table);
    if (auto table = root.table("outputs", Need::required, "must be a table of what is wanted"))
      outputs(*table);
    if (auto table = root.table("forward", Need::optional, "must be a table with method"))
      read_method(*table, spec_.method, nullptr);
    root.finish();
    check(root);
    report_.throw_if_any();
    return std::move(spec_);
  }

 private:
  void scene(TableReader& root) {
    const auto scene = root.text("scene", Need::optional, "must be the name of a scene file");
    const auto fit = root.text("fit", Need::optional, "must be the name of a fit file");
    if (scene.has_value() == fit.has_value()) {
      report_.add({1, 1}, {"scene", "", "must be given, or fit, but not both"});
      return;
    }
    const std::string path =
        (std::filesystem::path(source_.name()).parent_path() / (scene ? *scene : *fit)).string();
    if (scene) {
      spec_.scene = read_scene<double>(path, changes_);
      spec_.scene_text = scene_text(spec_.scene->spec());
    } else {
      spec_.scene_text = detail::TextSource::read(path).text();
      for (const SceneChange& c : changes_) spec_.scene_text += fmt::format("--set {}={}\n", c.key, c.value);
      spec_.fit_file = read_fit_file(path, changes_);
      spec_.scene = spec_.fit_file->spec.scene;
      spec_.method = spec_.fit_file->spec.forward.method;
      spec_.design = DesignKind::fit;
    }
  }

  void variation(TableReader& table) {
    Variation v;
    v.entry = table.text("entry", Need::required, "must be the name of an entry of the scene").value_or("");
    std::size_t n_kinds = table.node("list") ? 1 : 0;
    if (n_kinds == 1) {
      table.number("list", Need::optional, v.values);
      if (table.is_good("list") && v.values.empty())
        table.add(*table.node("list"), table.path("list"), "must have numbers");
    }
    for (std::size_t k = 1; k < kVariationNames.size(); ++k) {
      const std::string_view key = kVariationNames[k];
      if (!table.node(key)) continue;
      ++n_kinds;
      v.kind = static_cast<VariationKind>(k);
      std::vector<double> two;
      table.number(key, Need::optional, two);
      if (table.is_good(key)) numbers_of(table, key, two, v);
    }
    const bool is_range = v.kind == VariationKind::range || v.kind == VariationKind::log_range;
    if (is_range) {
      const auto count = table.count("count", Need::required, 1, kMostStudyRuns);
      if (count) fill_range(v, static_cast<std::size_t>(*count));
    }
    if (n_kinds != 1)
      report_.add(table.position(), {table.path("entry"), quoted_text(v.entry),
                                     fmt::format("must have one of: {}", fmt::join(kVariationNames, ", "))});
    table.finish();
    if (spec_.scene && !v.entry.empty()) check_entry(table, v);
    spec_.variations.push_back(std::move(v));
  }

  void numbers_of(TableReader& table, std::string_view key, const std::vector<double>& two, Variation& v) {
    const auto refuse = [&](std::string_view constraint) {
      table.add(*table.node(key), table.path(key), constraint);
    };
    if (two.size() != 2 || !std::isfinite(two[0]) || !std::isfinite(two[1]))
      return refuse("must be two numbers");
    v.first = two[0];
    v.second = two[1];
    const bool is_log = v.kind == VariationKind::log_range || v.kind == VariationKind::log_uniform;
    const bool has_spread = v.kind == VariationKind::normal || v.kind == VariationKind::lognormal;
    if (has_spread && !(v.second > 0)) return refuse("must have a second number > 0");
    if ((is_log || v.kind == VariationKind::lognormal) && !(v.first > 0))
      return refuse("must have a first number > 0");
    if (!has_spread && !(v.second > v.first)) return refuse("must ascend");
  }

  static void fill_range(Variation& v, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      const double part = n == 1 ? 0 : static_cast<double>(i) / static_cast<double>(n - 1);
      v.values.push_back(i + 1 == n && n > 1              ? v.second
                         : v.kind == VariationKind::range ? v.first + part * (v.second - v.first)
                                                          : v.first * std::pow(v.second / v.first, part));
    }
  }

  void check_entry(TableReader& table, const Variation& v) {
    std::vector<std::string> names;
    for (const Entry& entry : entries(spec_.scene->spec())) names.push_back(entry.name());
    const bool is_twice = std::any_of(spec_.variations.begin(), spec_.variations.end(),
                                      [&](const Variation& other) { return other.entry == v.entry; });
    const auto meant = nearest_name(v.entry, names);
    if (std::find(names.begin(), names.end(), v.entry) == names.end())
      table.add(*table.node("entry"), table.path("entry"),
                "must be a number of the scene" +
                    (meant ? " (did you mean " + *meant + "?)" : ", such as " + names.front()));
    else if (is_twice)
      table.add(*table.node("entry"), table.path("entry"), "must not vary twice");
  }

  void design(TableReader& table) {
    if (const auto i = table.place("kind", Need::optional, kDesignNames))
      spec_.design = static_cast<DesignKind>(*i);
    if (const auto n = table.count("runs", Need::optional, 1, kMostStudyRuns))
      spec_.runs = static_cast<std::size_t>(*n);
    if (const auto n = table.count("seed", Need::optional, 0, 9'007'199'254'740'991)) spec_.seed = *n;
    table.finish();
  }

  void outputs(TableReader& table) {
    if (table.node("events"))
      for (const std::string& name : table.texts("events", Need::optional, "must be an array of event times"))
        event(table, name);
    const auto times = [&](const char* key) {
      std::vector<double> values;
      if (table.node(key)) table.number(key, Need::optional, values);
      for (const double x : values)
        if (!(x >= 0 && std::isfinite(x)) && table.is_good(key)) {
          table.add(*table.node(key), table.path(key), "must be >= 0");
          break;
        }
      return values;
    };
    std::vector<double> heights;
    if (table.node("heights")) table.number("heights", Need::optional, heights);
    const std::vector<double> at = times("times");
    for (const double z : heights)
      if (spec_.scene && !(z >= spec_.scene->bottom() && z <= spec_.scene->top())) {
        table.add(*table.node("heights"), table.path("heights"), "must be inside the domain");
        break;
      }
    const auto quantities =
        table.node("quantities")
            ? table.texts("quantities", Need::optional, "must be an array of: phi, M, bed-height, mixing")
            : std::vector<std::string>{};
    for (const std::string& name : quantities) {
      const bool is_of_bed = name == "bed-height" || name == "mixing";
      if (!is_of_bed && name != "phi" && name != "M") {
        if (!name.empty())
          table.add(*table.node("quantities"), table.path("quantities"),
                    "must be of: phi, M, bed-height, mixing");
        break;
      }
      if (at.empty() || (!is_of_bed && heights.empty()))
        table.add(*table.node("quantities"), table.path("quantities"),
                  "needs times, and phi and M also heights");
      for (const double t : at) {
        if (is_of_bed) {
          const Kind kind = name == "mixing" ? Kind::mixing : Kind::height;
          spec_.outputs.push_back(
              {kind, 0, t, 0, fmt::format("{}({})", kind == Kind::mixing ? "Psi" : "H", number_text(t))});
          continue;
        }
        for (const double z : heights)
          spec_.outputs.push_back({name == "phi" ? Kind::phi : Kind::M, 0, t, z,
                                   fmt::format("{}({};{})", name, number_text(t), number_text(z))});
      }
    }
    if (table.boolean("estimates", Need::optional).value_or(false)) estimates(table);
    if (spec_.outputs.empty() && report_.is_empty())
      report_.add(table.position(), {"outputs", "", "must ask for events, quantities or estimates"});
    table.finish();
  }

  void estimates(TableReader& table) {
    if (spec_.design != DesignKind::replicates || !spec_.fit_file)
      return table.add(*table.node("estimates"), table.path("estimates"),
                       "must be of a fit file with design.kind = \"replicates\"");
    const FitSpec& fit = spec_.fit_file->spec;
    std::size_t i = 0;
    for (const Parameter& p : Parameters(fit.scene, fit.unknown)) {
      spec_.outputs.push_back({Kind::estimate, i, 0, 0, p.name()});
      spec_.outputs.push_back({Kind::std_error, i++, 0, 0, "std_error(" + p.name() + ")"});
    }
    spec_.outputs.push_back({Kind::misfit, 0, 0, 0, "misfit"});
  }

  /// "t_0", "t_1", "t*", "t_c(1)", "t^_c(1)", as `events` calls them.
  void event(TableReader& table, const std::string& name) {
    StudyOutput output;
    output.name = name;
    if (name == "t_0") {
      output.kind = Kind::t0;
    } else if (name == "t_1") {
      output.kind = Kind::t1;
    } else if (name == "t*") {
      output.kind = Kind::t_star;
    } else {
      const std::size_t open = name.find('(');
      const std::string event = name.substr(0, open);
      unsigned long long i = 1;
      if (open != std::string::npos)
        i = name.ends_with(')') ? parse_count(name.substr(open + 1, name.size() - open - 2)).value_or(0) : 0;
      if ((event != "t_c" && event != "t^_c") || i < 1) {
        if (!name.empty())
          table.add(*table.node("events"), table.path("events"), "must be of: t_0, t_1, t*, t_c(1), t^_c(1)");
        return;
      }
      output.kind = event == "t_c" ? Kind::first : Kind::last;
      output.interface = static_cast<std::size_t>(i - 1);
    }
    spec_.outputs.push_back(std::move(output));
  }

  void check(TableReader& root) {
    const toml::node* design = root.node("design");
    const auto refuse = [&](const std::string& key, const std::string& constraint) {
      report_.add(design ? TomlSource::position(*design) : detail::Position{1, 1}, {key, "", constraint});
    };
    const bool is_fit = spec_.design == DesignKind::fit || spec_.design == DesignKind::replicates;
    if (is_fit != spec_.fit_file.has_value())
      return refuse("design.kind", "must be fit or replicates for a fit file, and only for one");
    if (spec_.fit_file && spec_.fit_file->choice)
      return refuse("fit", "must be a file of one model, without [compare]");
    if (!is_fit && spec_.variations.empty())
      return refuse("vary", "missing; must be [[vary]] tables, what is to vary");
    if (is_fit && !spec_.variations.empty()) return refuse("vary", "must not stand beside fit");
    if (spec_.design != DesignKind::grid) {
      if (spec_.runs == 0) refuse("design.runs", "missing; must be a whole number");
      return;
    }
    double n = 1;
    for (const Variation& v : spec_.variations) {
      if (!v.is_finite_set())
        return refuse("design.kind", "must be another than grid: " + v.entry + " has a distribution");
      n *= static_cast<double>(v.values.size());
    }
    if (n > static_cast<double>(kMostGridRuns))
      refuse("design", fmt::format("must have at most 1e8 runs, not {:.3g}", n));
  }

  const TomlSource& source_;
  ComplaintReport report_;
  SceneChanges changes_;
  StudySpec spec_;
};

}  // namespace

StudySpec read_study(const std::string& path, const SceneChanges& changes) {
  return StudyReader(TomlSource(detail::TextSource::read(path)), changes).read();
}

}  // namespace shearfront::fit
