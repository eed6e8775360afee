// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/scene_text.hpp"

#include <fmt/format.h>

#include <string_view>
#include <variant>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront {
namespace {

/// A basic string of TOML.
std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (byte < 0x20 || byte == 0x7F)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + '"';
}

std::string toml_value(double x) { return number_text(x); }
std::string toml_value(const std::vector<double>& xs) {
  std::string out = "[";
  for (std::size_t i = 0; i < xs.size(); ++i) (out += i == 0 ? "" : ", ") += number_text(xs[i]);
  return out + ']';
}

class SceneWriter {
 public:
  std::string write(const SceneSpec<double>& spec) {
    line("name", toml_string(spec.name));
    fluxes(spec);
    table("shear_rate", spec.shear_rate);
    line("scale", toml_value(spec.scale));
    optional_table("solid_fraction", spec.solid_fraction);
    optional_table("temperature", spec.temperature);
    optional_table("close_packing", spec.close_packing);
    if (spec.diffusion) diffusion(*spec.diffusion);
    optional_table("velocity", spec.velocity);
    if (spec.slab) {
      text_ += "\n[slab]\n";
      line("length", toml_value(spec.slab->length));
    }
    if (spec.initial_block) {
      text_ += "\n[initial]\nmodel = \"block\"\n";
      line("x", toml_value(spec.initial_block->x));
      line("z", toml_value(spec.initial_block->z));
      line("inside", toml_value(spec.initial_block->inside));
      line("outside", toml_value(spec.initial_block->outside));
    } else if (spec.initial_state) {
      table("initial", *spec.initial_state);
    } else {
      text_ += "\n[initial]\n";
      line("breaks", toml_value(spec.initial_breaks));
      line("values", toml_value(spec.initial_values));
    }
    text_ += "\n[domain]\n";
    line("bottom", toml_value(spec.bottom));
    line("top", toml_value(spec.top));
    ends(spec);
    if (spec.units.are_given()) {
      text_ += "\n[units]\n";
      if (!spec.units.z.empty()) line("z", toml_string(spec.units.z));
      if (!spec.units.t.empty()) line(spec.units.symbol(), toml_string(spec.units.t));
    }
    return std::move(text_);
  }

 private:
  void line(std::string_view key, const std::string& value) { text_ += fmt::format("{} = {}\n", key, value); }

  template <class Model>
  void entries(const Model& model) {
    line("model", toml_string(Model::kName));
    visit_choices(model, [&](const ChoiceInfo& info, const auto& member) {
      line(info.key, toml_string(info.names[static_cast<std::size_t>(member)]));
    });
    Model::fields(model,
                  [&](const FieldInfo& info, const auto& member) { line(info.key, toml_value(member)); });
  }
  template <class... Models>
  void table(std::string_view name, const std::variant<Models...>& model) {
    text_ += fmt::format("\n[{}]\n", name);
    std::visit([&](const auto& m) { entries(m); }, model);
  }
  template <class Variant>
  void optional_table(std::string_view name, const std::optional<Variant>& model) {
    if (model) table(name, *model);
  }

  void fluxes(const SceneSpec<double>& spec) {
    for (std::size_t i = 0; i < spec.fluxes.size(); ++i) {
      text_ += spec.fluxes.size() == 1 ? "\n[flux]\n" : "\n[[flux]]\n";
      with_model(spec.fluxes[i], [&]<class Model>(const Model& model) {
        if constexpr (requires { Model::kName; }) entries(model);
      });
      if (i > 0) line("above", toml_value(spec.flux_breaks[i - 1]));
    }
  }

  void diffusion(const Diffusion<double>& diffusion) {
    text_ += "\n[diffusion]\n";
    line("D", toml_value(diffusion.D));
    if (diffusion.follows_shear_rate)
      line("proportional_to", toml_string("shear_rate"));
    else if (diffusion.variation)
      std::visit([&](const auto& m) { entries(m); }, *diffusion.variation);
  }

  void ends(const SceneSpec<double>& spec) {
    if (spec.is_neumann || spec.is_periodic) text_ += "\n[boundary]\n";
    if (spec.is_neumann) line("neumann", "true");
    if (spec.is_periodic) line("periodic", "true");
    const auto outside = [&](std::string_view side, const std::optional<OutsideState<double>>& state) {
      if (!state) return;
      text_ += fmt::format("\n[boundary.{}]\n", side);
      line("breaks", toml_value(state->breaks));
      line("values", toml_value(state->values));
    };
    outside("bottom", spec.outside_bottom);
    outside("top", spec.outside_top);
  }

  std::string text_;
};

}  // namespace

std::string scene_text(const SceneSpec<double>& spec) { return SceneWriter().write(spec); }

}  // namespace shearfront
