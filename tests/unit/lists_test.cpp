// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/fit/loss/all.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/model/depth/all.hpp"
#include "shearfront/model/depth/skeleton.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/model/flux/skeleton.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/skeleton.hpp"

/// The lists of models: what the program, the scene files and the laws take from them.
namespace shearfront {
namespace {

template <class List>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  List::for_each([&]<class T>() { names.emplace_back(T::kName); });
  return names;
}

/// A name is typed by users in scene files and on command lines.
bool is_plain(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

template <class List>
void expect_good_names() {
  const auto names = names_of<List>();
  EXPECT_EQ(names.size(), List::kSize);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size()) << List::names();
  for (const std::string& name : names) {
    EXPECT_TRUE(is_plain(name)) << name;
    EXPECT_NE(name, "skeleton") << "a copy of the skeleton needs a name of its own";
    EXPECT_TRUE(List::contains(name));
  }
  EXPECT_FALSE(List::contains("skeleton"));
  EXPECT_FALSE(List::contains(""));
}

TEST(Lists, FluxNamesAreDistinctAndPlain) { expect_good_names<FluxList<double>>(); }
TEST(Lists, ShearRateNamesAreDistinctAndPlain) { expect_good_names<DepthFunctionList<double>>(); }
TEST(Lists, VelocityNamesAreDistinctAndPlain) { expect_good_names<VelocityList<double>>(); }
TEST(Lists, SolverNamesAreDistinctAndPlain) { expect_good_names<SolverList>(); }
TEST(Lists, MisfitNamesAreDistinctAndPlain) { expect_good_names<fit::MisfitList>(); }
TEST(Lists, LossNamesAreDistinctAndPlain) { expect_good_names<fit::LossList>(); }

TEST(Lists, ModelsAreTheSameInEveryScalar) {
  EXPECT_EQ(names_of<DepthFunctionList<double>>(), names_of<DepthFunctionList<Real110>>());
  EXPECT_EQ(names_of<FluxList<double>>(), names_of<FluxList<Real110>>());
}

TEST(Lists, NamesJoinsInOrder) {
  EXPECT_EQ(DepthFunctionList<double>::names(),
            "piecewise, exponential, table, chute, kinetic, bagnold, scaling-velocity, scaling-table, "
            "scaling-exponential, scaling-kinetic, scaling-bagnold");
}

TEST(Lists, EveryListedTypeHasSamples) {
  FluxList<double>::for_each([]<class F>() { EXPECT_FALSE(F::samples().empty()) << F::kName; });
  DepthFunctionList<double>::for_each([]<class A>() { EXPECT_FALSE(A::samples().empty()) << A::kName; });
}

TEST(Lists, EveryListedTypeDescribesItself) {
  FluxList<double>::for_each([]<class F>() { EXPECT_FALSE(F::kFormula.empty()) << F::kName; });
  DepthFunctionList<double>::for_each([]<class A>() { EXPECT_FALSE(A::kFormula.empty()) << A::kName; });
  SolverList::for_each([]<class S>() { EXPECT_FALSE(S::kDescription.empty()) << S::kName; });
  fit::MisfitList::for_each([]<class M>() { EXPECT_FALSE(M::kDescription.empty()) << M::kName; });
  fit::LossList::for_each([]<class L>() { EXPECT_FALSE(L::kDescription.empty()) << L::kName; });
}

Scene<double> half_and_half() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1.0}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0.0, 1.0};
  return Scene<double>(std::move(spec));
}

TEST(Skeletons, FluxWorksAsItStands) {
  using F = TypeList<SkeletonFlux<double>>::Variant;
  EXPECT_EQ(std::visit([](const auto& f) { return f.value(0.25); }, F{}), -0.75);
  const SkeletonFlux<Real110> flux{Real110(0.25)};
  EXPECT_EQ(flux.secant(Real110(0.25), Real110(0.25)), flux.derivative(Real110(0.25)));
  EXPECT_EQ(flux.value(Real110(0.25)), Real110(-0.1875));
}

TEST(Skeletons, ShearRateWorksAsItStands) {
  for (const auto& rate : SkeletonDepthFunction<double>::samples()) {
    Complaints complaints;
    rate.fields(rate, [&](const FieldInfo& info, const auto& x) {
      check_number(std::string(info.key), info.range, x, complaints);
    });
    rate.check("shear_rate.", 0.0, 1.0, complaints);
    EXPECT_TRUE(complaints.empty());
    EXPECT_EQ(rate.harmonic_mean(0.25, 0.75), rate.value(0.5));
    EXPECT_TRUE(rate.knots().empty());
  }
}

TEST(Skeletons, SolverWorksAsItStands) {
  const Scene<double> scene = half_and_half();
  EXPECT_EQ(SkeletonSolver::refusal(scene, {}), "");
  const auto run = SkeletonSolver::start(scene, {}, {});
  for (const double t : {0.0, 1.0}) {
    ASSERT_EQ(run->advance(t), Status::ok);
    EXPECT_EQ(run->field().at(0.25).phi, 0);
    EXPECT_EQ(run->field().at(0.75).phi, 1);
    EXPECT_EQ(run->field().at(0.75).M, 0.25);
  }
  EXPECT_TRUE(run->summary().usable());
}

}  // namespace
}  // namespace shearfront
