// SPDX-License-Identifier: BSD-3-Clause
// What numbers of a scene are called on the page.
import { fluxOf, rateModel, type Scene } from "./scene.ts";

const PHI: Record<string, string> = {
  quadratic: "share of small grains", cubic: "share of small grains",
  lwr: "density of cars", "lwr-cubic": "density of cars", triangular: "density of cars",
  "richardson-zaki": "share of what settles", "buckley-leverett": "saturation with water",
};

const fluxModel = (scene: Scene): string => String(fluxOf(scene)["model"] ?? "quadratic");

/** What phi stands for; nothing where the flux has no meaning of its own. */
export const phiInWords = (scene: Scene): string => PHI[fluxModel(scene)] ?? "";
export const isOfGrains = (scene: Scene): boolean => ["quadratic", "cubic"].includes(fluxModel(scene));

/** Of the names in a fit file: one thing, several, and where they lie. */
const PARAMETERS: Record<string, [string, string]> = {
  "shear_rate.values": ["rate of layer", "rates of layers"], "shear_rate.breaks": ["interface", "interfaces"],
  "shear_rate.amplitude": ["amplitude of a(z)", "amplitude of a(z)"], "shear_rate.decay": ["decay length of a(z)", "decay length of a(z)"],
  "shear_rate.scale": ["scale s", "scale s"],
  "initial.values": ["start φ, piece", "φ of the start"], "initial.breaks": ["jump of the start", "jumps of the start"],
};

/** "shear_rate.values[2]" is the "rate of layer 3"; "flux.gamma" is "gamma of the flux". */
export function parameterInWords(scene: Scene, name: string): string {
  const [, key = name, index] = /^([^[]+)(?:\[(\d+)\])?$/.exec(name) ?? [];
  const [table = "", entry = ""] = key.split(".");
  let words = PARAMETERS[key];
  if (key === "shear_rate.values" && rateModel(scene) !== "piecewise") words = ["a at point", "a at its points"];
  if (!words && table === "flux") return `${entry} of the flux` + (index === undefined ? "" : ` ${Number(index) + 1}`);
  if (!words) return name;
  return index === undefined ? words[1] : `${words[0]} ${Number(index) + 1}`;
}
