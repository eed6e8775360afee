// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/prior.hpp"

#include <cmath>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::fit {

double Prior::low() const {
  switch (kind) {
    case PriorKind::uniform:
      return first;
    case PriorKind::normal:
      return -infinity<double>();
    case PriorKind::lognormal:
    case PriorKind::half_normal:
      break;
  }
  return 0;
}

double Prior::high() const { return kind == PriorKind::uniform ? second : infinity<double>(); }

PriorDensity Prior::log_density(double p) const {
  if (!(p >= low() && p <= high())) return {-infinity<double>(), 0};
  if (own) return own(p);
  switch (kind) {
    case PriorKind::uniform:
      break;
    case PriorKind::normal: {
      const double r = (p - first) / second;
      return {-r * r / 2, -r / second};
    }
    case PriorKind::lognormal: {
      if (p == 0) return {-infinity<double>(), 0};
      const double r = std::log(p / first) / second;
      return {-r * r / 2 - std::log(p), -(r / second + 1) / p};
    }
    case PriorKind::half_normal: {
      const double r = p / first;
      return {-r * r / 2, -r / first};
    }
  }
  return {0, 0};
}

std::string Prior::refusal() const {
  if (kind == PriorKind::uniform) return first < second ? "" : "must ascend";
  if (!std::isfinite(first) || !std::isfinite(second)) return "must have finite numbers";
  if (kind == PriorKind::lognormal && !(first > 0)) return "must have a median > 0";
  const double deviation = kind == PriorKind::half_normal ? first : second;
  return deviation > 0 ? "" : "must have a standard deviation > 0";
}

std::string Prior::text() const {
  std::string all(kPriorNames[static_cast<std::size_t>(kind)]);
  all += " [" + number_text(first);
  if (kind != PriorKind::half_normal) all += ", " + number_text(second);
  return all + "]";
}

}  // namespace shearfront::fit
