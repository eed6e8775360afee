// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/fit_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/fit/forward.hpp"
#include "shearfront/fit/loss/all.hpp"
#include "shearfront/fit/method_table.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/model_choice_table.hpp"
#include "shearfront/fit/observation_tables.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/fit/prior_table.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/io/detail/toml_source.hpp"
#include "shearfront/io/method_text.hpp"
#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::fit {
namespace {

using detail::ComplaintReport;
using detail::TableReader;
using detail::TomlSource;
using Need = TableReader::Need;

constexpr unsigned long long kMostStarts = 1'000'000, kMostEvaluations = 1'000'000'000,
                             kMostReplicates = 1'000'000, kMostThreads = 1024,
                             kLargestSeed =
                                 9'007'199'254'740'991;  // exact in a double, and so for every program

/// The stopping rule of Buerger, Martinez & Villada (2023): both tolerances 1e-3.
constexpr double kPaperTolerance = 1e-3;
constexpr std::size_t kPaperEvaluations = 2000;

/// Only fit files have these at their top.
constexpr std::array kFitKeys{"scene", "observations", "unknown"};

template <class List>
std::vector<std::string> names_in() {
  std::vector<std::string> names;
  List::for_each([&]<class Member>() { names.emplace_back(Member::kName); });
  return names;
}

/// Puts a complaint where its entry stands in the file, with the number as it is written there.
void add_located(const TomlSource& source, ComplaintReport& report, Complaint complaint) {
  const TomlSource::Found found = source.find(complaint.key);
  if (found.is_exact && found.node->is_number()) complaint.value = source.shown(*found.node);
  report.add(TomlSource::position(*found.node), TomlSource::shown_position(*found.node, found.around),
             std::move(complaint));
}

bool has_keys_of_fit(const TomlSource& source) {
  return std::any_of(kFitKeys.begin(), kFitKeys.end(),
                     [&](const char* key) { return source.root().contains(key); });
}

class FitReader {
 public:
  explicit FitReader(const TomlSource& source, SceneChanges changes = {})
      : source_(source), report_(source.name()), changes_(std::move(changes)) {}
  FitReader(const TomlSource& source, Scene<double> scene, Observations observations)
      : source_(source), report_(source.name()), scene_(std::move(scene)), data_(std::move(observations)) {}

  FitFile read() {
    TableReader root(source_, report_, "", source_.root());
    const auto refuse = [this](Complaint complaint) { add(std::move(complaint)); };
    const auto name = root.text("name", Need::optional, "must be text");
    std::optional<std::string> scene_path, data_path;
    if (!scene_) scene_path = file_name(root, "scene", "must be the name of a scene file");
    if (!data_) data_path = file_name(root, "observations", "must be the name of a CSV file");
    if (scene_path) load("scene", [&] { scene_ = read_scene<double>(*scene_path, changes_); });
    if (!data_) read_observation_format(root, refuse, format_);
    if (auto table = root.table("compare", Need::optional, "must be a table with layers and models"))
      choice_ = read_model_choice(*table, refuse);
    const Need need = choice_ ? Need::optional : Need::required;
    if (auto table = root.table("unknown", need, "must be a table with parameters")) unknown(*table);
    if (auto table = root.table("forward", Need::optional, "must be a table with method"))
      read_method(*table, forward_.method, scene_ ? &*scene_ : nullptr);
    if (auto table = root.table("misfit", Need::optional, "must be a table with quantity and loss"))
      misfit(*table);
    if (auto table = root.table("search", Need::optional, "must be a table with algorithm")) search(*table);
    if (auto table = root.table("uncertainty", Need::optional, "must be a table with profile and bootstrap"))
      uncertainty(*table);
    if (root.table("prior", Need::optional, "must be a table of unknowns with distributions"))
      priors_ = read_priors(source_, report_);
    root.finish();

    if (data_path)
      load("observations", [&] {
        data_ = scene_ ? read_observations(*data_path, *scene_, format_)
                       : read_observations(*data_path, -HUGE_VAL, HUGE_VAL, format_);
      });
    check_unknown();
    check_quantity();
    throw_if_any();
    remarks_.insert(remarks_.begin(), scene_->spec().remarks.begin(), scene_->spec().remarks.end());
    return {FitSpec{name.value_or(std::filesystem::path(source_.name()).stem().string()), std::move(*scene_),
                    std::move(*data_), std::move(unknown_), std::move(forward_), std::move(misfit_),
                    std::move(search_), uncertainty_, std::move(priors_)},
            scene_path.value_or(""), data_path.value_or(""), std::move(remarks_), std::move(choice_)};
  }

 private:
  std::optional<std::string> file_name(TableReader& root, std::string_view key, std::string_view what) {
    const auto name = root.text(key, Need::required, what);
    if (!name) return std::nullopt;
    if (name->empty() || name->find('\0') != std::string::npos) {
      root.add(*root.node(key), root.path(key), what);
      return std::nullopt;
    }
    return (std::filesystem::path(source_.name()).parent_path() / *name).string();
  }

  void unknown(TableReader& table) {
    unknown_.parameters = table.texts("parameters", choice_ ? Need::optional : Need::required,
                                      "must be an array of names of entries");
    for (std::size_t i = 0; choice_ && i < unknown_.parameters.size(); ++i)
      if (unknown_.parameters[i].starts_with("shear_rate.")) {
        add({fmt::format("{}[{}]", table.path("parameters"), i), quoted_text(unknown_.parameters[i]),
             "must be left out: [compare] says which entries of the shear rate are unknown"});
        report_.spoil(table.path("parameters"));
      }
    for (std::string& name : unknown_.parameters)
      if (name.starts_with("packing.")) {
        const std::string old = std::exchange(name, "solid_fraction" + name.substr(name.find('.')));
        remarks_.push_back(printable(source_.name()) + ": " + printable(old) + " is the old name of " +
                           printable(name));
      }
    numbers(table, "start", unknown_.start, false);
    numbers(table, "lower", unknown_.lower, true);
    numbers(table, "upper", unknown_.upper, true);
    constexpr std::array<std::string_view, 3> kShapes{"none", "decreasing", "convex"};
    if (const auto i = table.place("shape", Need::optional, kShapes)) unknown_.shape = static_cast<Shape>(*i);
    table.finish();
  }

  /// One number per unknown; bounds may be infinite.
  void numbers(TableReader& table, std::string_view key, std::vector<double>& values, bool may_be_infinite) {
    table.number(key, Need::optional, values);
    const std::string path = table.path(key);
    if (!table.is_good(key)) {
      if (table.node(key)) has_bad_numbers_ = true;
      return;
    }
    if (values.empty()) add({path, "(0 entries)", "must have one number per unknown, or be left out"});
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string element = path + "[" + std::to_string(i) + "]";
      const bool is_spoiled = report_.is_spoiled(element);
      const bool is_bad = std::isnan(values[i]) || (std::isinf(values[i]) && !may_be_infinite);
      if (is_bad && !is_spoiled)
        add({element, "", may_be_infinite ? "must be a number or inf" : "must be a finite number"});
      has_bad_numbers_ = has_bad_numbers_ || is_spoiled || is_bad;
    }
  }

  void misfit(TableReader& table) {
    misfit_.quantity = table.choice("quantity", Need::optional, names_in<MisfitList>()).value_or("");
    misfit_.loss = table.choice("loss", Need::optional, names_in<LossList>()).value_or("");
    double scale = 0;
    table.number("loss_scale", Need::optional, scale);
    if (table.is_good("loss_scale")) {
      misfit_.loss_scale = scale;
      if (!(scale > 0 && std::isfinite(scale)))
        add({table.path("loss_scale"), "", "must be > 0 (in units of sigma)"});
    }
    misfit_.two_stage = table.boolean("two_stage", Need::optional);
    table.finish();
  }

  void search(TableReader& table) {
    if (auto name = table.choice("algorithm", Need::optional, algorithm_names())) search_.algorithm = *name;
    if (table.choice("settings", Need::optional, {"default", "paper"}).value_or("") == "paper") {
      search_.tolerance = kPaperTolerance;
      search_.max_evaluations = kPaperEvaluations;
    }
    if (const auto n = table.count("starts", Need::optional, 1, kMostStarts))
      search_.starts = static_cast<std::size_t>(*n);
    if (const auto n = table.count("seed", Need::optional, 0, kLargestSeed)) search_.seed = *n;
    if (const auto n = table.count("max_evaluations", Need::optional, 1, kMostEvaluations))
      search_.max_evaluations = static_cast<std::size_t>(*n);
    table.number("tolerance", Need::optional, search_.tolerance);
    if (table.is_good("tolerance") && !(search_.tolerance > 0 && search_.tolerance < 1))
      add({table.path("tolerance"), "", "must be > 0 and < 1"});
    table.finish();
  }

  void uncertainty(TableReader& table) {
    uncertainty_.profile = table.boolean("profile", Need::optional).value_or(false);
    if (const auto n = table.count("bootstrap", Need::optional, 0, kMostReplicates))
      uncertainty_.bootstrap = static_cast<std::size_t>(*n);
    if (const auto n = table.count("seed", Need::optional, 0, kLargestSeed)) uncertainty_.seed = *n;
    if (const auto n = table.count("threads", Need::optional, 0, kMostThreads))
      uncertainty_.threads = static_cast<std::size_t>(*n);
    table.finish();
  }

  /// Reads another file. One that cannot be read at all is a complaint about the entry that names it; those
  /// inside it are its own.
  template <class Read>
  void load(const char* key, Read&& read) {
    try {
      read();
    } catch (const FileError& error) {
      const Complaint& first = error.complaints().front();
      if (first.kind != Complaint::Kind::unreadable)
        others_.push_back(error);
      else
        add({key, source_.shown(*source_.find(key).node), first.constraint});
    }
  }

  /// Unknowns against the scene. Numbers that could not be read are left out, and so is what follows from it.
  void check_unknown() {
    if (choice_ && unknown_.parameters.empty()) return;
    if (!scene_ || report_.is_spoiled("unknown.parameters") || !source_.find("unknown.parameters").is_exact)
      return;
    UnknownSpec unknown = unknown_;
    if (choice_) unknown.shape = Shape::none;  // of what is compared
    if (has_bad_numbers_) unknown.start = unknown.lower = unknown.upper = {};
    try {
      check_priors(priors_, Parameters(*scene_, unknown), source_, report_);
    } catch (const InputError& error) {
      for (Complaint complaint : error.complaints()) {
        if (report_.is_spoiled(complaint.key)) continue;
        if (has_bad_numbers_ && complaint.key.find("unknown.parameters") == std::string::npos) continue;
        if (complaint.key.starts_with("unknown.start") && unknown.start.empty())
          complaint.constraint += "; without start it is the value of the scene";
        add(std::move(complaint));
      }
    }
  }

  void check_quantity() {
    if (!data_) return;
    MisfitList::for_each([&]<class M>() {
      if (misfit_.quantity != M::kName) return;
      if (const std::string refusal = M::refusal(*data_); !refusal.empty())
        add({"misfit.quantity", quoted_text(M::kName), refusal});
    });
  }

  void throw_if_any() {
    if (auto own = report_.error()) others_.insert(others_.begin(), std::move(*own));
    detail::throw_joined(others_);
  }

  void add(Complaint complaint) { add_located(source_, report_, std::move(complaint)); }

  const TomlSource& source_;
  ComplaintReport report_;
  SceneChanges changes_;
  std::vector<FileError> others_;  ///< of the scene and of the observations
  std::optional<Scene<double>> scene_;
  std::optional<Observations> data_;
  ObservationFormat format_;
  UnknownSpec unknown_;
  ForwardSpec forward_;
  MisfitSpec misfit_;
  SearchSpec search_;
  UncertaintySpec uncertainty_;
  std::vector<Prior> priors_;
  std::vector<std::string> remarks_;
  std::optional<ModelChoice> choice_;
  bool has_bad_numbers_ = false;  ///< in start, lower or upper
};

}  // namespace

FitFile parse_fit(std::string text, const std::string& file) {
  return FitReader(TomlSource(detail::TextSource(file, std::move(text)))).read();
}

FitFile parse_fit(std::string text, const std::string& file, Scene<double> scene, Observations observations) {
  const TomlSource source(detail::TextSource(file, std::move(text)));
  return FitReader(source, std::move(scene), std::move(observations)).read();
}

FitFile read_fit_file(const std::string& path, const SceneChanges& changes) {
  return FitReader(TomlSource(detail::TextSource::read(path)), changes).read();
}

FitSpec read_fit(const std::string& path) { return read_fit_file(path).spec; }

std::variant<Scene<double>, FitFile> read_scene_or_fit(const std::string& path, const SceneChanges& changes) {
  detail::TextSource text = detail::TextSource::read(path);
  const TomlSource source(text);
  if (has_keys_of_fit(source)) return FitReader(source, changes).read();
  return parse_scene<double>(text.text(), path, changes);
}

bool is_fit_file(const std::string& path) {
  return has_keys_of_fit(TomlSource(detail::TextSource::read(path)));
}

FileError located(const InputError& error, const std::string& path) {
  try {
    const TomlSource source(detail::TextSource::read(path));
    ComplaintReport report(path);
    for (const Complaint& complaint : error.complaints()) add_located(source, report, complaint);
    report.throw_if_any();
  } catch (const FileError& with_places) {
    return with_places;
  }
  return {error.complaints(), error.what()};
}

}  // namespace shearfront::fit
