// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "shearfront/model/complaint.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/numeric/scalar.hpp"

/// Self-description of the numeric entries of a model. A model lists its fields once, in
///     template <class Self, class Visit> static void fields(Self& self, Visit&& visit)
/// which calls visit(FieldInfo, member) for each; members are Scalar or std::vector<Scalar>. Scene files,
/// validation, messages and the parameter names of a fit are all generated from it.
namespace shearfront {

/// What a single number must satisfy (besides being finite, which all must be).
enum class Range { any, positive };

/// What a number of any sign is a number of: a change of it is small or large beside the height of the bed, the
/// width of the range of states, or the largest flux. A number that must be positive is its own measure.
enum class Measure { number, height, state, flux };

/// What else a single number must satisfy, if that does not depend on other numbers; for positive ones 0 is a limit already.
struct Limits {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool are_included = false;
};

struct FieldInfo {
  std::string_view key;  ///< name inside the model's table, e.g. "values"
  Range range = Range::any;
  bool is_optional = false;  ///< a scene file may leave it out; the member's initial value then counts
  Measure measure = Measure::number;
  Limits limits{};
  std::string_view also{};  ///< what depends on other numbers, in words; checked by the model
  [[nodiscard]] double low() const {
    return range == Range::positive ? std::max(0.0, limits.low) : limits.low;
  }
};

/// "> 0", "between 0 and 1", "> 0 and < 0.95, less than jam": all that an entry must be, empty for any number.
[[nodiscard]] std::string range_text(const FieldInfo& info);

/// An entry that is one of a few names, in the order of the enumerators of the member. A model with such
/// entries lists them in
///     template <class Self, class Visit> static void choices(Self& self, Visit&& visit)
/// which calls visit(ChoiceInfo, member) for each. All of them are optional in scene files.
struct ChoiceInfo {
  std::string_view key;
  std::span<const std::string_view> names;
};

/// Calls visit(ChoiceInfo, member) for the choices of a model that has some.
template <class Model, class Visit>
void visit_choices(Model& model, Visit&& visit) {
  if constexpr (requires { Model::choices(model, visit); }) Model::choices(model, visit);
}

/// Adds a complaint for every number of the field that is not finite or outside its range.
template <Real S>
void check_number(const std::string& key, Range range, const S& x, Complaints& complaints) {
  if (!is_finite(x)) {
    complaints.push_back({key, number_text(x), "must be a finite number"});
  } else if (range == Range::positive && !(x > 0)) {
    complaints.push_back({key, number_text(x), "must be > 0"});
  }
}

template <Real S>
void check_number(const std::string& key, Range range, const std::vector<S>& xs, Complaints& complaints) {
  for (std::size_t i = 0; i < xs.size(); ++i)
    if (!is_finite(xs[i]) ||
        (range == Range::positive && !(xs[i] > 0)))  // no text for the many that are right
      check_number(key + "[" + std::to_string(i) + "]", range, xs[i], complaints);
}

/// Adds a complaint for every number that is not finite, not in its range or beyond its limits.
template <class Member>
void check_field(const std::string& key, const FieldInfo& info, const Member& member,
                 Complaints& complaints) {
  const auto within = [&](const std::string& name, const auto& x) {
    using S = std::decay_t<decltype(x)>;
    if (!is_finite(x)) return check_number(name, info.range, x, complaints);
    const auto [low, high, are_included] = info.limits;
    const bool is_low = are_included ? x < S(low) : !(x > S(info.low())),
               is_high = are_included ? x > S(high) : !(x < S(high));
    if (!is_low && !is_high) return;
    complaints.push_back({name, number_text(x),
                          are_included ? "must be between " + number_text(low) + " and " + number_text(high)
                          : is_low     ? "must be > " + number_text(info.low())
                                       : "must be < " + number_text(high)});
  };
  if constexpr (!requires { member.begin(); }) {
    within(key, member);
  } else {
    constexpr Limits kNone{};
    if (info.limits.low == kNone.low && info.limits.high == kNone.high)
      return check_number(key, info.range, member, complaints);
    for (std::size_t i = 0; i < member.size(); ++i) within(key + "[" + std::to_string(i) + "]", member[i]);
  }
}

/// Breaks of a piecewise function: finite, strictly increasing, strictly inside (bottom, top).
template <Real S>
void check_breaks(const std::string& key, const std::vector<S>& breaks, const S& bottom, const S& top,
                  Complaints& complaints) {
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    if (!is_finite(breaks[i])) continue;  // reported by check_number
    const auto element = [&] { return key + "[" + std::to_string(i) + "]"; };
    if (!(breaks[i] > bottom) || !(breaks[i] < top)) {
      complaints.push_back(
          {element(), number_text(breaks[i]),
           "must be inside the domain (" + number_text(bottom) + ", " + number_text(top) + ")"});
    } else if (i > 0 && is_finite(breaks[i - 1]) && !(breaks[i] > breaks[i - 1])) {
      complaints.push_back({element(), number_text(breaks[i]),
                            "must be greater than the break before it (" + number_text(breaks[i - 1]) + ")"});
    }
  }
}

/// Points (z[i], values[i]) of a function on the domain: at least two, ascending, from its bottom to its top. A function
/// that may jump has a height inside twice, with the values below and above.
template <Real S>
void check_points(const std::string& prefix, const std::vector<S>& z, std::size_t n_values, const S& bottom,
                  const S& top, Complaints& complaints, bool may_jump = false) {
  if (z.size() < 2)
    complaints.push_back(wrong_length(prefix + "z", z.size(), "must have at least 2 entries"));
  if (n_values != z.size())
    complaints.push_back(wrong_length(prefix + "values", n_values,
                                      "must have as many entries as z (" + std::to_string(z.size()) + ")"));
  for (std::size_t i = 1; i < z.size(); ++i)
    if (is_finite(z[i]) && is_finite(z[i - 1]) && !(z[i] > z[i - 1])) {
      const bool is_jump = may_jump && z[i] == z[i - 1] && i > 1 && i + 1 < z.size() && z[i - 2] < z[i];
      if (!is_jump)
        complaints.push_back(
            {prefix + "z[" + std::to_string(i) + "]", number_text(z[i]),
             "must be greater than the entry before it (" + number_text(z[i - 1]) + ")" +
                 (may_jump && z[i] == z[i - 1] ? "; a height inside may be given twice" : "")});
    }
  if (!z.empty() && z.front() > bottom)
    complaints.push_back({prefix + "z[0]", number_text(z.front()),
                          "must not lie above the bottom of the domain (" + number_text(bottom) + ")"});
  if (z.size() > 1 && z.back() < top)
    complaints.push_back({prefix + "z[" + std::to_string(z.size() - 1) + "]", number_text(z.back()),
                          "must not lie below the top of the domain (" + number_text(top) + ")"});
}

}  // namespace shearfront
