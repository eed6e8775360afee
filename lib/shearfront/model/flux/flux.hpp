// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <concepts>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/model/flux/model.hpp"
#include "shearfront/model/flux/quadratic.hpp"

namespace shearfront {

/// A flux of any model: what model/flux/model.hpp says of it, without its type. So what holds a flux need not be compiled
/// again when a model changes; loops that want the model itself use with_model() of model/flux/all.hpp. The model need not
/// be in the list there: any type that is a FluxModel will do, and every engine takes it (scene files do not).
///
/// A value: copies are independent. Cost of a call: that of the model and a virtual call.
template <Real Scalar>
class Flux {
 public:
  /// Known of no Flux before it is asked: is_parabola().
  static constexpr bool kIsParabola = false;

  Flux() : Flux(Quadratic<Scalar>{}) {}
  template <FluxModel<Scalar> Model>
  Flux(Model model) : held_(std::make_unique<Held<Model>>(std::move(model))), type_(&kTypeOf<Model>) {}
  Flux(const Flux& other) : held_(other.held_->copy()), type_(other.type_) {}
  Flux(Flux&& other) noexcept = default;
  Flux& operator=(const Flux& other) {
    held_ = other.held_->copy();
    type_ = other.type_;
    return *this;
  }
  Flux& operator=(Flux&& other) noexcept = default;
  ~Flux() = default;

  [[nodiscard]] std::string_view name() const { return held_->facts().name; }
  [[nodiscard]] bool is_parabola() const { return held_->facts().is_parabola; }
  [[nodiscard]] bool is_quadratic_polynomial() const { return held_->facts().is_quadratic_polynomial; }
  [[nodiscard]] StateRange<Scalar> range() const { return held_->range(); }
  [[nodiscard]] std::vector<Scalar> extrema() const { return held_->extrema(); }
  [[nodiscard]] Curvature curvature() const { return held_->curvature(); }
  [[nodiscard]] Scalar value(const Scalar& phi) const { return held_->value(phi); }
  [[nodiscard]] Scalar derivative(const Scalar& phi) const { return held_->derivative(phi); }
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const { return held_->secant(p, q); }
  /// Of polynomials between extrema and joints; large for any other flux.
  [[nodiscard]] int degree_between_joints() const { return held_->degree_between_joints(); }
  [[nodiscard]] std::vector<Scalar> joints() const { return held_->joints(); }
  void check(const std::string& prefix, Complaints& complaints) const { held_->check(prefix, complaints); }

  /// Calls visit(FieldInfo, member) for the model's entries of a scene file, as the models do.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    for (const auto& [info, place] : self.held_->entries()) {
      if (auto* const* number = std::get_if<Scalar*>(&place))
        visit(info, static_cast<Same<Self, Scalar>&>(**number));
      else
        visit(info, static_cast<Same<Self, std::vector<Scalar>>&>(*std::get<std::vector<Scalar>*>(place)));
    }
  }

  /// The model itself if it is of this type, nullptr otherwise; for with_model().
  template <class Model>
  [[nodiscard]] const Model* as() const {
    return type_ == &kTypeOf<Model> ? &static_cast<const Held<Model>&>(*held_).model : nullptr;
  }

 private:
  template <class Self, class Member>
  using Same = std::conditional_t<std::is_const_v<Self>, const Member, Member>;
  template <class Model>
  static constexpr char kTypeOf = 0;  ///< its address stands for the type

  struct Facts {
    std::string_view name;
    bool is_parabola, is_quadratic_polynomial;
  };
  struct Place {
    FieldInfo info;
    std::variant<Scalar*, std::vector<Scalar>*> member;
  };
  struct Any {
    virtual ~Any() = default;
    [[nodiscard]] virtual std::unique_ptr<Any> copy() const = 0;
    [[nodiscard]] virtual Facts facts() const = 0;
    [[nodiscard]] virtual StateRange<Scalar> range() const = 0;
    [[nodiscard]] virtual std::vector<Scalar> extrema() const = 0;
    [[nodiscard]] virtual Curvature curvature() const = 0;
    [[nodiscard]] virtual Scalar value(const Scalar& phi) const = 0;
    [[nodiscard]] virtual Scalar derivative(const Scalar& phi) const = 0;
    [[nodiscard]] virtual Scalar secant(const Scalar& p, const Scalar& q) const = 0;
    virtual void check(const std::string& prefix, Complaints& complaints) const = 0;
    [[nodiscard]] virtual std::vector<Place> entries() = 0;
    [[nodiscard]] virtual int degree_between_joints() const = 0;
    [[nodiscard]] virtual std::vector<Scalar> joints() const = 0;
  };
  template <class Model>
  struct Held final : Any {
    explicit Held(Model m) : model(std::move(m)) {}
    std::unique_ptr<Any> copy() const override { return std::make_unique<Held>(model); }
    Facts facts() const override {
      return {Model::kName, Model::kIsParabola, shearfront::is_quadratic_polynomial<Model>()};
    }
    StateRange<Scalar> range() const override { return model.range(); }
    std::vector<Scalar> extrema() const override { return model.extrema(); }
    Curvature curvature() const override { return model.curvature(); }
    Scalar value(const Scalar& phi) const override { return model.value(phi); }
    Scalar derivative(const Scalar& phi) const override { return model.derivative(phi); }
    Scalar secant(const Scalar& p, const Scalar& q) const override { return model.secant(p, q); }
    void check(const std::string& prefix, Complaints& complaints) const override {
      model.check(prefix, complaints);
    }
    std::vector<Place> entries() override {
      std::vector<Place> all;
      Model::fields(model, [&](const FieldInfo& info, auto& member) { all.push_back({info, &member}); });
      return all;
    }
    int degree_between_joints() const override { return shearfront::degree_between_joints<Model>(); }
    std::vector<Scalar> joints() const override {
      if constexpr (requires { model.joints(); }) return model.joints();
      return {};
    }
    Model model;
  };

  std::unique_ptr<Any> held_;
  const char* type_;  ///< of the model
};

/// +1 for phi (phi - 1), -1 for phi (1 - phi) on 0 <= phi <= 1, 0 for any other flux.
template <Real Scalar>
[[nodiscard]] int unit_parabola_sign(const Flux<Scalar>& flux) {
  if (!flux.is_parabola()) return 0;
  const auto range = flux.range();
  if (!(range.lowest == 0) || !(range.highest == 1)) return 0;
  const Scalar f = flux.value((range.lowest + range.highest) / 2);
  return f == -0.25 ? 1 : f == 0.25 ? -1 : 0;
}

}  // namespace shearfront
