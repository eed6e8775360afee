// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/scene_file.hpp"

#include <filesystem>
#include <utility>

#include "shearfront/io/detail/toml_source.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront {
namespace {

using detail::Position;
using detail::ProblemReport;
using detail::TableReader;
using detail::TomlSource;
using Need = TableReader::Need;

/// A number of entries in parentheses stands for a length, not for the text of a value.
bool is_length(const Problem& problem) { return problem.value.ends_with(" entries)"); }

std::string table_of(const std::string& key) { return key.substr(0, key.find('.')); }

template <Real S>
class SceneReader {
 public:
  explicit SceneReader(const TomlSource& source) : source_(source), report_(source.name()) {}

  Scene<S> read() {
    TableReader root(source_, report_, "", source_.root());
    const auto name = root.text("name", Need::optional, "must be text");
    spec_.name = name.value_or(std::filesystem::path(source_.name()).stem().string());
    if (auto table = root.table("flux", Need::optional, "must be a table with model")) flux(*table);
    if (auto table = root.table("shear_rate", Need::required, "must be a table with model and its entries"))
      shear_rate(*table);
    if (auto table = root.table("initial", Need::required, "must be a table with breaks and values")) {
      table->number("breaks", Need::required, spec_.initial_breaks);
      table->number("values", Need::required, spec_.initial_values);
      table->finish();
    }
    if (auto table = root.table("domain", Need::optional, "must be a table with bottom and top")) {
      table->number("bottom", Need::optional, spec_.bottom);
      table->number("top", Need::optional, spec_.top);
      table->finish();
    }
    root.finish();
    check();
    report_.throw_if_any();
    return Scene<S>(std::move(spec_));
  }

 private:
  void flux(TableReader& table) {
    const std::string what = "must be one of: " + FluxList::names();
    const auto model = table.text("model", Need::optional, what);
    const bool is_known = model_by_name<FluxList>(table, model ? *model : Quadratic::kName, what, spec_.flux);
    if (is_known) table.finish();
  }

  void shear_rate(TableReader& table) {
    using List = ShearRateList<S>;
    const std::string what = "must be one of: " + List::names();
    const auto model = table.text("model", Need::required, what);
    knows_shear_rate_ = model && model_by_name<List>(table, *model, what, spec_.shear_rate);
    table.number("scale", Need::optional, spec_.scale);
    if (knows_shear_rate_) table.finish();  // otherwise nobody knows which keys are right
  }

  /// Reads the entries of the model with this name; false if there is none.
  template <class List, class Variant>
  bool model_by_name(TableReader& table, std::string_view name, const std::string& what, Variant& model) {
    bool is_known = false;
    List::for_each([&]<class Model>() {
      if (name != Model::kName) return;
      is_known = true;
      Model entries;
      Model::fields(entries, [&](const FieldInfo& info, auto& member) {
        table.number(info.key, Need::required, member);
      });
      model = std::move(entries);
    });
    if (!is_known) table.add(*table.node("model"), table.path("model"), what);
    return is_known;
  }

  /// Adds what is wrong with the values, unless it only repeats or follows from what is reported already.
  void check() {
    for (Problem& problem : find_problems(spec_)) {
      const std::string table = table_of(problem.key);
      if (report_.is_spoiled(problem.key)) continue;
      if (is_length(problem) && report_.is_spoiled(TableReader::lengths(table))) continue;
      if (!knows_shear_rate_ && table == "shear_rate" && problem.key != "shear_rate.scale") continue;
      const TomlSource::Found found = source_.find(problem.key);
      if (found.is_exact && found.node->is_number()) problem.value = source_.shown(*found.node);
      report_.add(TomlSource::position(*found.node), TomlSource::shown_position(*found.node, found.around),
                  std::move(problem));
    }
  }

  const TomlSource& source_;
  ProblemReport report_;
  SceneSpec<S> spec_;
  bool knows_shear_rate_ = false;
};

}  // namespace

template <Real S>
Scene<S> parse_scene(std::string text, const std::string& file) {
  return SceneReader<S>(TomlSource(detail::TextSource(file, std::move(text)))).read();
}

template <Real S>
Scene<S> read_scene(const std::string& path) {
  return SceneReader<S>(TomlSource(detail::TextSource::read(path))).read();
}

template Scene<double> read_scene(const std::string&);
template Scene<Real50> read_scene(const std::string&);
template Scene<Real110> read_scene(const std::string&);
template Scene<double> parse_scene(std::string, const std::string&);
template Scene<Real50> parse_scene(std::string, const std::string&);
template Scene<Real110> parse_scene(std::string, const std::string&);

}  // namespace shearfront
