// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cole_hopf_refusal.hpp"

namespace shearfront::diffusion {

namespace {

std::string refused(const std::string& what) {
  return what + " has no exact solution with diffusion: only crank-nicolson applies";
}

}  // namespace

std::string cole_hopf_refusal(const ColeHopfFacts& facts) {
  if (!facts.is_one_rate) return refused("a shear rate that varies or is 0");
  if (!facts.is_one_diffusivity) return refused("a diffusivity that varies or is 0");
  switch (facts.start) {
    case ColeHopfStart::uniform:
    case ColeHopfStart::steady:
      if (!facts.is_quadratic) return refused("a flux other than quadratic between walls");
      if (!facts.has_walls) return refused("a uniform or steady start without walls at both ends");
      return {};
    case ColeHopfStart::kink:
      if (!facts.is_quadratic) return refused("a kink of a flux other than quadratic");
      if (!facts.is_neumann) return refused("a kink between ends other than neumann");
      return {};
    case ColeHopfStart::sine:
      if (!facts.is_burgers) return refused("a sine of a flux other than burgers");
      if (!facts.is_periodic) return refused("a sine that is not periodic");
      return {};
    case ColeHopfStart::other:
      break;
  }
  return refused("a start other than uniform, steady, kink and sine");
}

}  // namespace shearfront::diffusion
