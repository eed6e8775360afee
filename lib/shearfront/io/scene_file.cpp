// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/scene_file.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "shearfront/io/detail/scene_columns.hpp"
#include "shearfront/io/detail/toml_source.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {
namespace {

using detail::ComplaintReport;
using detail::SceneColumns;
using detail::TableReader;
using detail::TomlSource;
using Need = TableReader::Need;

/// Names of older files, which are still read.
constexpr std::string_view kOldFlux = "packed", kOldSolidFraction = "packing";

/// "shear_rate" of "shear_rate.values", "flux[1]" of "flux[1].gamma".
std::string table_of(const std::string& key) { return key.substr(0, key.rfind('.')); }

template <Real S>
class SceneReader {
 public:
  SceneReader(const TomlSource& source, const SceneChanges& changes)
      : source_(source), changes_(changes), report_(source.name()) {}

  Scene<S> read() {
    TableReader root(source_, report_, "", source_.root());
    const auto name = root.text("name", Need::optional, "must be text");
    spec_.name = name.value_or(std::filesystem::path(source_.name()).stem().string());
    domain_and_units();
    columns_.emplace(spec_.units);
    fluxes(root.tables("flux", Need::optional, "must be a table with model, or an array of such tables"));
    if (auto table = root.table("shear_rate", Need::required, "must be a table with model and its entries"))
      shear_rate(*table);
    solid_fraction(root);
    optional_model<DepthFunctionList<S>>(root, "temperature", spec_.temperature);
    optional_model<ClosePackingList<S>>(root, "close_packing", spec_.close_packing);
    if (auto table = root.table("diffusion", Need::optional, "must be a table with D")) diffusion(*table);
    optional_model<VelocityList<S>>(root, "velocity", spec_.velocity);
    if (auto table = root.table("slab", Need::optional, "must be a table with length")) {
      table->number("length", Need::required, spec_.slab.emplace().length);
      table->finish();
    }
    if (auto table = root.table("initial", Need::required, "must be a table with breaks and values"))
      initial(*table);
    (void)root.table("domain", Need::optional, kDomain);
    if (auto table = root.table("boundary", Need::optional, "must be a table")) boundary(*table);
    (void)root.table("units", Need::optional, kUnits);
    if (root.node("uncertain")) (void)root.table("uncertain", Need::optional, "must be a table of entries");
    root.finish();
    for (const SceneChange& change : changes_) apply(change);
    spec_.remarks.insert(spec_.remarks.end(), columns_->remarks().begin(), columns_->remarks().end());
    std::variant<Scene<S>, Complaints> scene = Scene<S>::make(std::move(spec_));
    if (auto* complaints = std::get_if<Complaints>(&scene)) add(std::move(*complaints));
    throw_if_any();
    return std::get<Scene<S>>(std::move(scene));
  }

 private:
  struct ArrayEntry {
    std::string_view key;
    Need need;
    SceneColumns::Meaning meaning;
    std::vector<S>* numbers;
  };

  static constexpr std::string_view kDomain = "must be a table with bottom and top",
                                    kUnits = "must be a table with z and t";
  /// Before the arrays that may stand in other files, wherever they are in this one.
  void domain_and_units() {
    TableReader root(source_, report_, "", source_.root());
    if (auto table = root.table("domain", Need::optional, kDomain)) {
      table->number("bottom", Need::optional, spec_.bottom);
      table->number("top", Need::optional, spec_.top);
      table->finish();
    }
    spec_.units.is_chute = root.node("velocity") && !root.node("slab");
    if (auto table = root.table("units", Need::optional, kUnits)) detail::read_units(*table, spec_.units);
  }

  void fluxes(std::vector<TableReader> tables) {
    if (tables.empty()) return;
    using List = FluxList<S>;
    const std::string what = "must be one of: " + List::names();
    spec_.fluxes.clear();
    for (TableReader& table : tables) {
      const bool is_first = spec_.fluxes.empty();
      if (!is_first) table.number("above", Need::required, spec_.flux_breaks.emplace_back());
      const auto model = table.text("model", Need::optional, what);
      const std::string_view name = model ? std::string_view(*model) : Quadratic<S>::kName;
      if (name == kOldFlux)
        old_flux(table);
      else if (model_by_name<List>(table, name, what, spec_.fluxes.emplace_back()))
        table.finish();
      else
        report_.spoil(table.path("model"));
    }
  }

  /// "packed" of older files: one flux with two signs.
  void old_flux(TableReader& table) {
    const bool is_large = table.choice("grains", Need::optional, {"small", "large"}) == "large";
    if (is_large)
      spec_.fluxes.emplace_back(Lwr<S>{});
    else
      spec_.fluxes.emplace_back(Quadratic<S>{});
    table.finish();
    remark(table.path("model"), quoted_text(kOldFlux),
           quoted_text(is_large ? Lwr<S>::kName : Quadratic<S>::kName));
  }
  /// [solid_fraction], which older files call [packing].
  void solid_fraction(TableReader& root) {
    optional_model<DepthFunctionList<S>>(root, "solid_fraction", spec_.solid_fraction);
    const toml::node* old = root.node(kOldSolidFraction);
    if (!old) return;
    if (root.node("solid_fraction"))
      root.add(*old, root.path(kOldSolidFraction),
               "must not stand beside solid_fraction, whose old name it is");
    else
      remark("", "[" + std::string(kOldSolidFraction) + "]", "[solid_fraction]");
    solid_fraction_table_ = kOldSolidFraction;
    optional_model<DepthFunctionList<S>>(root, kOldSolidFraction, spec_.solid_fraction);
  }
  void remark(const std::string& key, const std::string& old_name, const std::string& name) {
    spec_.remarks.push_back(printable(source_.name()) + ": " + (key.empty() ? "" : key + " = ") + old_name +
                            " is the old name of " + name);
  }

  void shear_rate(TableReader& table) {
    using List = DepthFunctionList<S>;
    const std::string what = "must be one of: " + List::names();
    const auto model = table.text("model", Need::required, what);
    const bool is_known = model && model_by_name<List>(table, *model, what, spec_.shear_rate);
    if (!is_known) unknown_.emplace_back("shear_rate");
    table.number("scale", Need::optional, spec_.scale);
    if (is_known) table.finish();  // otherwise nobody knows which keys are right
  }

  /// A table that may be missing.
  template <class List, class Variant>
  void optional_model(TableReader& root, std::string_view key, std::optional<Variant>& variant) {
    auto table = root.table(key, Need::optional, "must be a table with model and its entries");
    if (!table) return;
    const std::string what = "must be one of: " + List::names();
    const auto model = table->text("model", Need::required, what);
    if (model && model_by_name<List>(*table, *model, what, variant.emplace()))
      table->finish();
    else
      unknown_.emplace_back(key);
  }

  void diffusion(TableReader& table) {
    Diffusion<S>& diffusion = spec_.diffusion.emplace();
    table.number("D", Need::required, diffusion.D);
    if (const auto other = table.choice("proportional_to", Need::optional, {"shear_rate"}))
      diffusion.follows_shear_rate = true;
    if (!table.node("model")) return table.finish();
    if (diffusion.follows_shear_rate)
      table.add(*table.node("model"), table.path("model"), "must not stand beside proportional_to");
    using List = DepthFunctionList<S>;
    const std::string what = "must be one of: " + List::names();
    const auto model = table.text("model", Need::required, what);
    if (model && model_by_name<List>(table, *model, what, diffusion.variation.emplace()))
      table.finish();
    else
      unknown_.emplace_back("diffusion");
  }

  void initial(TableReader& table) {
    if (!table.node("model")) {
      arrays(table, {{"breaks", Need::required, SceneColumns::Meaning::height, &spec_.initial_breaks},
                     {"values", Need::required, SceneColumns::Meaning::state, &spec_.initial_values}});
      return table.finish();
    }
    using List = InitialStateList<S>;
    const std::string what = "must be one of: " + List::names() + ", block";
    const auto model = table.text("model", Need::required, what);
    if (model && *model == "block") {
      Block<S>& block = spec_.initial_block.emplace();
      arrays(table, {{"x", Need::required, SceneColumns::Meaning::number, &block.x},
                     {"z", Need::required, SceneColumns::Meaning::height, &block.z}});
      table.number("inside", Need::required, block.inside);
      table.number("outside", Need::required, block.outside);
      return table.finish();
    }
    if (model && model_by_name<List>(table, *model, what, spec_.initial_state.emplace()))
      table.finish();
    else
      unknown_.emplace_back("initial");
  }

  void boundary(TableReader& table) {
    spec_.is_neumann = table.boolean("neumann", Need::optional).value_or(false);
    spec_.is_periodic = table.boolean("periodic", Need::optional).value_or(false);
    const auto outside = [&](std::string_view key, std::optional<OutsideState<S>>& state) {
      auto side = table.table(key, Need::optional, "must be a table with values, and breaks in time");
      if (!side) return;
      state.emplace();
      arrays(*side, {{"breaks", Need::optional, SceneColumns::Meaning::time, &state->breaks},
                     {"values", Need::required, SceneColumns::Meaning::state, &state->values}});
      side->finish();
    };
    outside("bottom", spec_.outside_bottom);
    outside("top", spec_.outside_top);
    table.finish();
  }

  /// Reads the entries of the model with this name; false if there is none.
  template <class List, class Variant>
  bool model_by_name(TableReader& table, std::string_view name, const std::string& what, Variant& model) {
    bool is_known = false;
    List::for_each([&]<class Model>() {
      if (name != Model::kName) return;
      is_known = true;
      Model entries;
      std::vector<ArrayEntry> vectors;
      Model::fields(entries, [&](const FieldInfo& info, auto& member) {
        const Need need = info.is_optional ? Need::optional : Need::required;
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, S>)
          table.number(info.key, need, member);
        else
          vectors.push_back({info.key, need, meaning_of(table.path(info.key), info.measure), &member});
      });
      arrays(table, vectors);
      visit_choices(entries, [&](const ChoiceInfo& info, auto& member) {
        const std::vector<std::string> names(info.names.begin(), info.names.end());
        if (const auto chosen = table.choice(info.key, Need::optional, names))
          member = static_cast<std::decay_t<decltype(member)>>(
              std::find(names.begin(), names.end(), *chosen) - names.begin());
      });
      model = std::move(entries);
    });
    if (!is_known) table.add(*table.node("model"), table.path("model"), what);
    return is_known;
  }

  [[nodiscard]] SceneColumns::Meaning meaning_of(const std::string& key, Measure measure) const {
    using Meaning = SceneColumns::Meaning;
    if (measure == Measure::height) return Meaning::height;
    if (key == "shear_rate.values") return Meaning::rate;
    const bool is_fraction = measure == Measure::state || table_of(key) == solid_fraction_table_;
    return is_fraction ? Meaning::state : Meaning::number;
  }

  /// Arrays of a table: as they stand there, or columns of its `file`, which the entries then name.
  void arrays(TableReader& table, const std::vector<ArrayEntry>& entries) {
    std::optional<std::string> file;
    if (!entries.empty() && table.node("file"))
      file = table.text("file", Need::optional, "must be the name of a file with columns of numbers");
    std::vector<SceneColumns::Wanted> wanted;
    std::vector<std::vector<S>*> places;
    double lowest = to_double(spec_.bottom);
    for (const ArrayEntry& entry : entries) {
      const toml::node* node = table.node(entry.key);
      if (!table.node("file") || (node && !node->is_string())) {
        table.number(entry.key, entry.need, *entry.numbers);
        continue;
      }
      const auto column = table.text(entry.key, Need::optional, "must be the name of a column");
      const std::string key = table.path(entry.key);
      const bool are_breaks = entry.key == "breaks";
      if (are_breaks && entry.meaning == SceneColumns::Meaning::time) lowest = 0;
      wanted.push_back({key, column.value_or(std::string(entry.key)), entry.meaning, are_breaks});
      places.push_back(entry.numbers);
    }
    if (wanted.empty()) return;
    const auto path = std::filesystem::path(source_.name()).parent_path() / file.value_or("");
    std::optional<std::vector<SceneColumns::Numbers>> numbers;
    try {
      if (file) numbers = columns_->read(path.string(), wanted, lowest);
    } catch (const FileError& error) {
      const Complaint& first = error.complaints().front();
      if (first.kind == Complaint::Kind::unreadable)
        table.add(*table.node("file"), table.path("file"), first.constraint);
      else
        others_.push_back(error);
    }
    for (std::size_t c = 0; c < wanted.size(); ++c) {
      if (!numbers) {
        report_.spoil(wanted[c].key);
        report_.spoil(TableReader::lengths(table_of(wanted[c].key)));
        continue;
      }
      places[c]->clear();
      for (const std::string& cell : (*numbers)[c].cells)
        places[c]->push_back(detail::number_of_cell<S>(cell, (*numbers)[c]));
    }
  }

  void throw_if_any() {
    if (auto own = report_.error()) others_.insert(others_.begin(), std::move(*own));
    for (FileError& error : columns_->errors()) others_.push_back(std::move(error));
    detail::throw_joined(others_);
  }

  /// Puts a number in its place. Errors: InputError if there is none, or no number.
  void apply(const SceneChange& change) {
    const std::size_t bracket = change.key.find('[', change.key.rfind('.'));
    const std::string name = change.key.substr(0, bracket);
    const auto decimal = detail::parse_decimal(change.value);
    const auto refuse = [&](const std::string& constraint) {
      throw InputError("--set " + printable(change.key, 60), quoted_text(change.value), constraint);
    };
    if (!decimal || !detail::fits_double(*decimal)) refuse("must be a number");
    std::optional<unsigned long long> i;
    if (bracket != std::string::npos && change.key.ends_with(']'))
      i = parse_count(std::string_view(change.key).substr(bracket + 1, change.key.size() - bracket - 2));
    std::vector<std::string> names;
    bool is_done = false;
    visit_fields(spec_, [&](const std::string& key, const FieldInfo&, auto& member) {
      names.push_back(key);
      if (key != name || is_done) return;
      if constexpr (std::is_same_v<std::decay_t<decltype(member)>, S>) {
        if (bracket != std::string::npos) refuse("must be without [...]: the entry is one number");
        member = detail::value_of<S>(*decimal);
        is_done = true;
      } else {
        if (!i || *i >= member.size())
          refuse(member.empty() ? std::string("must be an entry that has numbers")
                                : "must name one of its numbers, " + key + "[0] to " + key + "[" +
                                      std::to_string(member.size() - 1) + "]");
        member[static_cast<std::size_t>(*i)] = detail::value_of<S>(*decimal);
        is_done = true;
      }
    });
    if (is_done) return;
    const auto meant = nearest_name(name, names);
    std::string all;
    for (const std::string& known : names) all += (all.empty() ? "" : ", ") + known;
    throw InputError(
        "--set " + printable(change.key, 60), "",
        "unknown entry; must be one of: " + all + (meant ? " (did you mean " + *meant + "?)" : ""));
  }
  /// The change of the entry a complaint is about, if there is one.
  [[nodiscard]] bool is_changed(const std::string& key) const {
    return std::any_of(changes_.begin(), changes_.end(),
                       [&](const SceneChange& change) { return change.key == key; });
  }

  /// Adds what is wrong with the values, unless it only repeats or follows from what is reported already.
  void add(Complaints complaints) {
    for (Complaint& complaint : complaints) {
      if (complaint.key.starts_with("solid_fraction")) complaint.key.replace(0, 14, solid_fraction_table_);
      const std::string table = table_of(complaint.key);
      if (report_.is_spoiled(complaint.key)) continue;
      if (complaint.kind == Complaint::Kind::wrong_length && report_.is_spoiled(TableReader::lengths(table)))
        continue;
      if (is_changed(complaint.key))
        throw InputError("--set " + complaint.key, complaint.value, complaint.constraint);
      const bool is_unknown = std::find(unknown_.begin(), unknown_.end(), table) != unknown_.end();
      if (is_unknown && complaint.key != "shear_rate.scale") continue;
      if (columns_->take(complaint)) continue;
      const TomlSource::Found found = source_.find(complaint.key);
      if (found.is_exact && (found.node->is_number() || found.node->is_string()))
        complaint.value = source_.shown(*found.node);
      report_.add(TomlSource::position(*found.node), TomlSource::shown_position(*found.node, found.around),
                  std::move(complaint));
    }
  }

  const TomlSource& source_;
  const SceneChanges& changes_;
  ComplaintReport report_;
  std::optional<SceneColumns> columns_;  ///< once the units are known
  std::vector<FileError> others_;        ///< of files with columns that are no text
  SceneSpec<S> spec_;
  std::string solid_fraction_table_ = "solid_fraction";  ///< as the file calls it
  std::vector<std::string> unknown_;                     ///< tables whose model is missing or unknown
};

}  // namespace

template <Real S>
Scene<S> parse_scene(std::string text, const std::string& file, const SceneChanges& changes) {
  return SceneReader<S>(TomlSource(detail::TextSource(file, std::move(text))), changes).read();
}

template <Real S>
Scene<S> read_scene(const std::string& path, const SceneChanges& changes) {
  return SceneReader<S>(TomlSource(detail::TextSource::read(path)), changes).read();
}

template Scene<Instantiated> read_scene(const std::string&, const SceneChanges&);
template Scene<Instantiated> parse_scene(std::string, const std::string&, const SceneChanges&);

}  // namespace shearfront
