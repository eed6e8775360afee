// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <array>
#include <string>
#include <type_traits>

#include "outcome.hpp"
#include "shearfront/fit/loss/all.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/io/method_text.hpp"
#include "shearfront/model/close_packing/all.hpp"
#include "shearfront/model/depth/all.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/model/start/all.hpp"

namespace shearfront::python {
namespace {

/// In the order of Measure.
constexpr std::array<const char*, 4> kMeasures{"number", "height", "state", "flux"};

template <class Model>
nb::list fields_of() {
  Model model{};
  nb::list fields;
  Model::fields(model, [&]<class Member>(const FieldInfo& info, const Member& member) {
    nb::dict field;
    field["key"] = std::string(info.key);
    field["is_array"] = !std::is_same_v<Member, double>;
    field["is_positive"] = info.range == Range::positive;
    field["is_optional"] = info.is_optional;
    field["measure"] = kMeasures[static_cast<std::size_t>(info.measure)];
    if constexpr (std::is_same_v<Member, double>) field["initial"] = member;
    fields.append(field);
  });
  return fields;
}

template <class Model>
nb::list choices_of() {
  Model model{};
  nb::list choices;
  visit_choices(model, [&](const ChoiceInfo& info, const auto& member) {
    nb::list names;
    for (const auto& name : info.names) names.append(std::string(name));
    choices.append(nb::make_tuple(std::string(info.key), names,
                                  std::string(info.names[static_cast<std::size_t>(member)])));
  });
  return choices;
}

template <class List>
nb::list models_in() {
  nb::list models;
  List::for_each([&]<class Model>() {
    nb::dict model;
    model["name"] = std::string(Model::kName);
    if constexpr (requires { Model::kFormula; }) model["formula"] = std::string(Model::kFormula);
    if constexpr (requires { Model::kStates; }) model["states"] = std::string(Model::kStates);
    model["fields"] = fields_of<Model>();
    model["choices"] = choices_of<Model>();
    models.append(model);
  });
  return models;
}

nb::dict models() {
  nb::dict lists;
  lists["flux"] = models_in<FluxList<double>>();
  lists["depth"] = models_in<DepthFunctionList<double>>();
  lists["start"] = models_in<InitialStateList<double>>();
  lists["velocity"] = models_in<VelocityList<double>>();
  lists["close_packing"] = models_in<ClosePackingList<double>>();
  return lists;
}

nb::list methods() {
  nb::list all;
  for (const std::string& name : Method::names()) {
    const Method method(name);
    const Guarantees promised = method.guarantees();
    nb::dict entry;
    entry["name"] = name;
    entry["description"] = std::string(method.description());
    entry["scenes"] = std::string(method.scenes());
    entry["exact"] = promised.exact;
    entry["diffusion"] = promised.diffusion;
    entry["has_fronts"] = promised.has_fronts;
    entry["has_timeline"] = promised.has_timeline;
    entry["has_profiles"] = promised.has_profiles;
    nb::list options;
    for (const OptionText& option : all_options())
      for (const OptionValues& values : option.values)
        for (const std::string& solver : values.solvers)
          if (solver == name)
            options.append(
                nb::make_tuple(option.name, option.kind, values.sentence, values.allowed, values.initial));
    entry["options"] = options;
    all.append(entry);
  }
  return all;
}

template <class Names>
nb::list list_of(const Names& names) {
  nb::list all;
  for (const auto& name : names) all.append(std::string(name));
  return all;
}

template <class List>
nb::list names_in() {
  nb::list all;
  List::for_each([&]<class Member>() { all.append(std::string(Member::kName)); });
  return all;
}

}  // namespace

void bind_models(nb::module_& m) {
  m.def("models", &models, "What every list of models holds: names, formulas, entries.");
  m.def("methods", &methods, "Every method with its options.");
  m.def("losses", &names_in<fit::LossList>);
  m.def("quantities", &names_in<fit::MisfitList>);
  m.def("algorithms", [] { return list_of(fit::algorithm_names()); });
}

}  // namespace shearfront::python
