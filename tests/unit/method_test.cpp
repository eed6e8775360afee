// SPDX-License-Identifier: BSD-3-Clause
// Solvers chosen by name, with options by name: what the command line, fit files, `compare` and `list` derive from.
#include "shearfront/solver/method.hpp"
#include "shearfront/solver/all.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "shearfront/io/method_text.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/checked.hpp"

namespace shearfront {
namespace {

SceneSpec<double> two_layer_bed() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.2913}, {2.4, 0.31}};
  spec.initial_breaks = {0.4968};
  spec.initial_values = {0.1, 0.9};
  return spec;
}

std::string message_of(const auto& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Methods, HaveTheNamesOfTheSolvers) {
  std::vector<std::string> names;
  SolverList::for_each([&]<class S>() {
    names.emplace_back(S::kName);
    const Method method(S::kName);
    EXPECT_EQ(method.name(), S::kName);
    EXPECT_EQ(method.description(), S::kDescription);
    EXPECT_EQ(method.scenes(), S::kScenes);
    EXPECT_EQ(settings(method), settings(Method::of<S>()));
    EXPECT_EQ(method.guarantees().exact, S::guarantees().exact);
  });
  EXPECT_EQ(Method::names(), names);
  EXPECT_EQ(Method().name(), names.front());
}

TEST(Methods, AreListedByWhatTheyPromise) {
  for (const auto property : {&Guarantees::exact, &Guarantees::has_timeline, &Guarantees::has_fronts,
                              &Guarantees::has_profiles, &Guarantees::diffusion}) {
    std::vector<std::string> names;
    for (const std::string& name : Method::names())
      if (Method(name).guarantees().*property) names.push_back(name);
    EXPECT_EQ(Method::names(property), names);
    EXPECT_FALSE(names.empty());
  }
}

TEST(Methods, AnUnknownNameListsThoseThatThereAre) {
  EXPECT_EQ(message_of([] { Method("hopf-lax"); }),
            "method = \"hopf-lax\"; must be one of: " + SolverList::names());
}

// Options of the same name are one on the command line and in fit files.
TEST(OptionsOfSolvers, AreListedOnceWithTheirSolvers) {
  std::set<std::string> names;
  for (const OptionText& option : all_options()) {
    SCOPED_TRACE(option.name);
    EXPECT_TRUE(names.insert(option.name).second);
    for (const OptionValues& some : option.values) {
      EXPECT_FALSE(some.sentence.empty());
      EXPECT_FALSE(some.sentence.ends_with('.'));
    }
    std::vector<std::string> solvers;
    for (const std::string& name : Method::names())
      if (Method(name).has_option(option.name)) solvers.push_back(name);
    EXPECT_EQ(option.solvers(), solvers);
    EXPECT_TRUE(std::all_of(option.name.begin(), option.name.end(),
                            [](char c) { return (c >= 'a' && c <= 'z') || c == '-'; }));
  }
  for (const std::string& name : Method::names())
    Method(name).visit_options([&](const OptionInfo& info, const auto&) {
      EXPECT_TRUE(names.contains(std::string(info.name))) << name << " " << info.name;
    });
}

// Kind of fault: what is true of the first of a list said of all. --tolerance of crank-nicolson was described as that of
// the exact method.
TEST(OptionsOfSolvers, AreDescribedAsEachSolverDoes) {
  for (const std::string& name : Method::names())
    Method(name).visit_options([&](const OptionInfo& info, const auto&) {
      int n_found = 0;
      for (const OptionText& o : all_options())
        for (const OptionValues& some : o.values)
          if (o.name == info.name && std::count(some.solvers.begin(), some.solvers.end(), name) > 0) {
            EXPECT_EQ(some.sentence, info.sentence) << name << ' ' << info.name;
            ++n_found;
          }
      EXPECT_EQ(n_found, 1) << name << ' ' << info.name;
    });
}

// Solvers that differ in what an option may be, or is by default, are told apart.
TEST(OptionsOfSolvers, AreListedWithTheValuesOfEachSolver) {
  const auto values_for = [](std::string_view option, const std::string& solver) {
    std::vector<std::string> found;
    for (const OptionText& o : all_options())
      for (const OptionValues& some : o.values)
        if (o.name == option &&
            std::find(some.solvers.begin(), some.solvers.end(), solver) != some.solvers.end())
          found.push_back(some.allowed + ", default " + some.initial);
    return found;
  };
  const auto refusal = [](const std::string& solver, std::string_view option, const char* text) {
    return message_of([&] {
      Method method(solver);
      set_option(method, option, text, "it");
    });
  };
  support::Checked checked({"cells", "layers", "resolution"});
  for (const std::string& solver : Method::names())
    Method(solver).visit_options([&]<class Member>(const OptionInfo& info, const Member& member) {
      SCOPED_TRACE(solver + " " + std::string(info.name));
      const auto values = values_for(info.name, solver);
      ASSERT_EQ(values.size(), 1u);
      if (!info.unset.empty()) {
        EXPECT_TRUE(values[0].ends_with("default " + std::string(info.unset))) << values[0];
      }
      if constexpr (std::is_same_v<Member, double> || std::is_same_v<Member, std::uint64_t>) {
        // What is listed is what a refusal says, and the solver's own default.
        const auto own = [&] {
          if constexpr (std::is_same_v<Member, double>) return number_text(member);
          return std::to_string(member);
        };
        if (info.unset.empty()) {
          EXPECT_TRUE(values[0].ends_with("default " + own())) << values[0];
        }
        const std::string why = refusal(solver, info.name, "-1");
        EXPECT_NE(why.find(values[0].substr(0, values[0].find(", default"))), std::string::npos)
            << why << " and " << values[0];
        checked.count(info.name);
      }
    });
  EXPECT_EQ(values_for("cells", "crank-nicolson")[0],
            "from 2 to 10000000, default 400, or 800 or 1600 where fronts are narrower");
  EXPECT_EQ(values_for("cells", "upwind")[0], "from 1 to 100000000, default 400");
  EXPECT_NE(values_for("tolerance", "exact"), values_for("tolerance", "crank-nicolson"));
}

// The default is allowed, or it says what it stands for.
TEST(OptionsOfSolvers, StartFromADefaultInTheirRange) {
  support::Checked checked({"number", "name", "unset"});
  for (const std::string& name : Method::names())
    Method(name).visit_options([&]<class Member>(const OptionInfo& info, const Member& member) {
      SCOPED_TRACE(name + " " + std::string(info.name));
      if constexpr (std::is_same_v<Member, OptionChoice>) {
        EXPECT_LT(member.index, info.names.size());
        checked.count("name");
      } else if constexpr (!std::is_same_v<Member, bool>) {
        EXPECT_LT(info.range.low, info.range.high);
        EXPECT_EQ(info.range.contains(static_cast<double>(member)), info.unset.empty());
        checked.count(info.unset.empty() ? "number" : "unset");
      }
    });
}

/// A text that sets an option to something other than its default.
struct OtherValue {
  template <class Member>
  static std::string of(const OptionInfo& info, const Member& member) {
    if constexpr (std::is_same_v<Member, bool>) {
      return member ? "false" : "true";
    } else if constexpr (std::is_same_v<Member, OptionChoice>) {
      return std::string(info.names[(member.index + 1) % info.names.size()]);
    } else {
      const double low = std::max(info.range.low, 1e-3), high = std::min(info.range.high, 1e4);
      return number_text(std::is_integral_v<Member> ? std::floor((low + high) / 2) : std::sqrt(low * high));
    }
  }
};

Method with_other_values(const std::string& name) {
  Method method(name);
  std::vector<std::pair<std::string, std::string>> texts;
  method.visit_options([&](const OptionInfo& info, const auto& member) {
    texts.emplace_back(info.name, OtherValue::of(info, member));
  });
  for (const auto& [option, text] : texts) set_option(method, option, text, option);
  return method;
}

/// The method that "--method exact --layers 8" asks for.
Method from_settings(const std::string& text) {
  std::istringstream words(text);
  std::string word, name;
  words >> word >> name;
  EXPECT_EQ(word, "--method");
  Method method(name);
  std::vector<std::string> rest;
  while (words >> word) rest.push_back(word);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const bool is_flag = i + 1 == rest.size() || rest[i + 1].starts_with("--");
    const std::string option = rest[i].substr(2);
    EXPECT_TRUE(method.has_option(option)) << rest[i];
    set_option(method, option, is_flag ? "true" : rest[++i], option);
  }
  return method;
}

TEST(OptionsOfSolvers, SettingsGiveTheSameMethodAgain) {
  for (const std::string& name : Method::names()) {
    EXPECT_EQ(settings(from_settings(settings(Method(name)))), settings(Method(name)));
    const Method other = with_other_values(name);
    EXPECT_EQ(settings(from_settings(settings(other))), settings(other));
    other.visit_options([&](const OptionInfo& info, const auto&) {
      EXPECT_NE(settings(other).find("--" + std::string(info.name)), std::string::npos) << name << info.name;
    });
  }
}

TEST(OptionsOfSolvers, RefuseWhatIsNotAllowedByTheirKey) {
  Method method("front-tracking");
  const auto refusal = [&](const char* option, const char* text) {
    return message_of([&] { set_option(method, option, text, "--" + std::string(option)); });
  };
  EXPECT_EQ(refusal("resolution", "0"), "--resolution = 0; must be > 0 and <= 1");
  EXPECT_EQ(refusal("resolution", "nan"), "--resolution = \"nan\"; must be a number > 0 and <= 1");
  EXPECT_EQ(refusal("resolution", "fine"), "--resolution = \"fine\"; must be a number > 0 and <= 1");
  EXPECT_EQ(refusal("max-fronts", "0"), "--max-fronts = 0; must be a whole number from 1 to 2000000000");
  EXPECT_EQ(refusal("max-fronts", "2.5"), "--max-fronts = 2.5; must be a whole number from 1 to 2000000000");
  EXPECT_EQ(refusal("grid", "fine"), "--grid = \"fine\"; must be one of: levels, singular-mapping");
  method = Method("crank-nicolson");
  EXPECT_EQ(refusal("monotone", "yes"), "--monotone = \"yes\"; must be true or false");
  EXPECT_EQ(refusal("time-step", "0"), "--time-step = 0; must be > 0");
}

/// Derivatives of what a method computes, against differences of it: two layers, all entries that have some.
void check_linearisation(const Method& method, const SceneSpec<double>& spec, double step, double bound,
                         support::Checked& checked) {
  const Scene<double> scene(spec);
  ASSERT_EQ(method.refusal(scene), "");
  const std::vector<Place> places{{0.07, 0.45}, {0.1, 0.52}, {0.2, 0.31}, {0.2, 0.6}};
  const std::vector<Entry> all = entries(spec);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (method.has_derivative(scene, all[i])) wanted.push_back(i);
  std::any memory;
  const Linearisation at = method.linearise(scene, places, wanted, memory);
  ASSERT_TRUE(at.summary.usable()) << at.summary.message;
  ASSERT_EQ(at.samples.size(), places.size());
  ASSERT_EQ(at.derivatives.size(), places.size() * wanted.size());
  // The same steps in time, if the method has any: differences of two choices of them are noise.
  const auto samples = [&](std::size_t entry, double by) {
    SceneSpec<double> moved = spec;
    *entry_places(moved)[entry] += by;
    return method.linearise(Scene<double>(moved), places, {}, memory).samples;
  };
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto above = samples(wanted[k], step), below = samples(wanted[k], -step);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Sample& d = at.derivatives[i * wanted.size() + k];
      const double phi = (above[i].phi - below[i].phi) / (2 * step),
                   M = (above[i].M - below[i].M) / (2 * step);
      EXPECT_NEAR(d.phi, phi, bound * std::max(1.0, std::abs(phi)))
          << all[wanted[k]].name() << " place " << i;
      EXPECT_NEAR(d.M, M, bound * std::max(1.0, std::abs(M))) << all[wanted[k]].name() << " place " << i;
    }
    checked.count(all[wanted[k]].name());
  }
  // Samples alone are those of a run.
  const auto sampled = sample(scene, method, places).samples;
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(at.samples[i].M, sampled[i].M, 1e-9);
}

const std::initializer_list<std::string_view> kEntries{
    "shear_rate.values[0]", "shear_rate.values[1]", "shear_rate.breaks[0]", "shear_rate.scale",
    "initial.values[0]",    "initial.values[1]",    "initial.breaks[0]"};

TEST(Linearisation, OfTheExactSolutionIsItsDerivative) {
  support::Checked checked(kEntries);
  check_linearisation(Method::of<ExactSolver>(), two_layer_bed(), 1e-6, 1e-7, checked);
}

/// C++ gets the complaint that the program and Python give.
TEST(Places, OutsideTheBedAreRefused) {
  const Scene<double> scene(two_layer_bed());
  const double nan = std::nan("");
  const std::vector<Place> bad{{0.5, 0.2}, {0.5, 1.5}, {0.5, -1e-9}, {-1, 0.5}, {nan, nan}};
  const auto keys_of = [&](const auto& call) {
    std::vector<std::string> keys;
    try {
      call();
    } catch (const InputError& error) {
      for (const Complaint& complaint : error.complaints()) keys.push_back(complaint.key);
    }
    return keys;
  };
  const std::vector<std::string> expected{"places[1].z", "places[2].z", "places[3].t", "places[4].t",
                                          "places[4].z"};
  std::any memory;
  for (const Method& method : {Method::of<ExactSolver>(), Method("front-tracking")})
    EXPECT_EQ(keys_of([&] { (void)sample(scene, method, bad); }), expected) << method.name();
  EXPECT_EQ(keys_of([&] { (void)Method::of<ExactSolver>().linearise(scene, bad, {}, memory); }), expected);
}

TEST(Linearisation, OfCrankNicolsonIsTheDerivativeOfTheScheme) {
  support::Checked checked(kEntries);
  checked.expect("diffusion.D");
  SceneSpec<double> spec = two_layer_bed();
  spec.diffusion = Diffusion<double>{0.02, {}, false};
  check_linearisation(Method::of<CrankNicolsonSolver>({.cells = 60, .time_step = 0.01}), spec, 1e-5, 1e-4,
                      checked);
}

TEST(Linearisation, MethodsWithoutDerivativesSaySo) {
  const Scene<double> scene(two_layer_bed());
  for (const char* name : {"engquist-osher", "godunov"})
    for (const Entry& entry : entries(scene.spec()))
      EXPECT_FALSE(Method(name).has_derivative(scene, entry)) << name;
  for (const Entry& entry : entries(scene.spec()))
    EXPECT_TRUE(Method("front-tracking").has_derivative(scene, entry)) << entry.name();
  for (const Entry& entry : entries(scene.spec()))
    EXPECT_EQ(Method("exact").has_derivative(scene, entry),
              entry.field.starts_with("shear_rate.") || entry.field.starts_with("initial."))
        << entry.name();
}

}  // namespace
}  // namespace shearfront
