// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/unit.hpp"

#include <array>

namespace shearfront::detail {
namespace {

/// numerator / denominator of the base unit: quotients of whole numbers are exact where a decimal size is not.
struct NamedUnit {
  std::string_view name;
  UnitKind kind;
  double numerator, denominator;
};

constexpr std::array<NamedUnit, 32> kUnits{{
    {"um", UnitKind::length, 1, 1e6},        {"\u00b5m", UnitKind::length, 1, 1e6},
    {"\u03bcm", UnitKind::length, 1, 1e6},   {"mm", UnitKind::length, 1, 1e3},
    {"cm", UnitKind::length, 1, 100},        {"dm", UnitKind::length, 1, 10},
    {"m", UnitKind::length, 1, 1},           {"km", UnitKind::length, 1e3, 1},
    {"in", UnitKind::length, 254, 1e4},      {"ft", UnitKind::length, 3048, 1e4},
    {"mi", UnitKind::length, 1609344, 1e3},  {"us", UnitKind::time, 1, 1e6},
    {"\u00b5s", UnitKind::time, 1, 1e6},     {"\u03bcs", UnitKind::time, 1, 1e6},
    {"ms", UnitKind::time, 1, 1e3},          {"s", UnitKind::time, 1, 1},
    {"sec", UnitKind::time, 1, 1},           {"min", UnitKind::time, 60, 1},
    {"h", UnitKind::time, 3600, 1},          {"hr", UnitKind::time, 3600, 1},
    {"d", UnitKind::time, 86400, 1},         {"%", UnitKind::fraction, 1, 100},
    {"percent", UnitKind::fraction, 1, 100}, {"vol%", UnitKind::fraction, 1, 100},
    {"vol.%", UnitKind::fraction, 1, 100},   {"vol %", UnitKind::fraction, 1, 100},
    {"vol.-%", UnitKind::fraction, 1, 100},  {"pct", UnitKind::fraction, 1, 100},
    {"ppm", UnitKind::fraction, 1, 1e6},     {"1", UnitKind::fraction, 1, 1},
    {"-", UnitKind::fraction, 1, 1},         {"fraction", UnitKind::fraction, 1, 1},
}};

const NamedUnit* find(std::string_view name) {
  for (const NamedUnit& unit : kUnits)
    if (unit.name == name) return &unit;
  return nullptr;
}

}  // namespace

std::optional<Unit> unit_of(std::string_view name) {
  const NamedUnit* unit = find(name);
  if (!unit) return std::nullopt;
  return Unit{unit->kind, unit->numerator / unit->denominator};
}

std::optional<std::pair<double, double>> unit_ratio(std::string_view from, std::string_view to) {
  if (from == to) return std::pair(1.0, 1.0);
  const NamedUnit *a = find(from), *b = find(to);
  if (!a || !b || a->kind != b->kind) return std::nullopt;
  return std::pair(a->numerator * b->denominator, a->denominator * b->numerator);
}

std::optional<double> unit_factor(std::string_view from, std::string_view to) {
  const auto ratio = unit_ratio(from, to);
  if (!ratio) return std::nullopt;
  return ratio->first / ratio->second;
}

}  // namespace shearfront::detail
