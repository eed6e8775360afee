// SPDX-License-Identifier: BSD-3-Clause
// Why an event time is when it is: in words, and as a sum where it is one.
import { brief } from "../view/numbers.ts";
import type { NamedTime } from "./event_list.ts";
import type { Picture } from "./picture.ts";
import { bottomOf, fluxOf, hasSteps, numbers, rateModel, scaleOf, type Scene, table, topOf } from "./scene.ts";
import { isOfGrains } from "./words.ts";

/** Large grains below one jump, small ones above: the start of the paper. */
function isInverse(scene: Scene): boolean {
  const start = table(scene, "initial");
  return isOfGrains(scene) && hasSteps(scene) && numbers(start, "values").join() === "0,1";
}

/** Of a wave that runs from the jump to z through pure grains: its way through each layer over the layer's speed. */
function sumOfLayers(scene: Scene, m: NamedTime): string {
  if (!isInverse(scene) || fluxOf(scene)["model"] === "cubic" || rateModel(scene) !== "piecewise" || m.z === undefined) return "";
  const from = numbers(table(scene, "initial"), "breaks")[0]!;
  const rate = table(scene, "shear_rate");
  const values = numbers(rate, "values");
  const edges = [bottomOf(scene), ...numbers(rate, "breaks"), topOf(scene)];
  const [low, high] = [Math.min(from, m.z), Math.max(from, m.z)];
  const ways = values.map((a, i) => ({ low: Math.max(low, edges[i]!), high: Math.min(high, edges[i + 1]!), speed: a * scaleOf(scene) })).filter((w) => w.high > w.low);
  if (from > m.z) ways.reverse();
  const sum = ways.reduce((t, w) => t + (w.high - w.low) / w.speed, 0);
  if (ways.length === 0 || Math.abs(sum - m.t) > 1e-9 * m.t) return "";
  return ` Here ${m.formula} = ${ways.map((w) => `(${brief(w.high)} - ${brief(w.low)}) / ${brief(w.speed)}`).join(" + ")} = ${brief(sum)}.`;
}

/** Psi at a time, and where it is largest. */
export function mixingAt(picture: Picture, t: number): { psi: number; most: number; tMost: number; isRising: boolean } | undefined {
  const { t: times, psi } = picture.mixing;
  if (psi.length < 2) return undefined;
  const step = times[1]! - times[0]!;
  const i = Math.min(psi.length - 2, Math.max(0, Math.floor(t / step)));
  const share = Math.min(1, Math.max(0, t / step - i));
  const best = psi.indexOf(Math.max(...psi));
  const [before, at, after] = [psi[best - 1] ?? psi[best]!, psi[best]!, psi[best + 1] ?? psi[best]!];
  const bend = before - 2 * at + after; // the top of a parabola through three points
  const shift = best > 0 && best + 1 < psi.length && bend < 0 ? (before - after) / (2 * bend) : 0;
  return { psi: psi[i]! + share * (psi[i + 1]! - psi[i]!), most: at, tMost: times[best]! + shift * step, isRising: best + 1 === psi.length };
}

const GRAINS: Record<string, string> = {
  "t_c": "The edge of the fan reaches the interface. At its edges the grains are pure, and there waves run with the full speed s a of their layer. Until t_c the layer beyond does not know of the jump.",
  "t_0": "The lower edge of the fan meets the bottom. From here on small grains pile up there: a shock rises.",
  "t_1": "The upper edge of the fan meets the top. From here on large grains pile up there, and a shock of pure large grains runs down.",
  "t*": "The shock from the bottom and that from the top have met: all small grains lie below, all large ones above.",
};

const MIXED = "Inside a fan both kinds of grains are present at every height, and by t_1 it covers nearly the whole bed: that is why the bed is about as well mixed then as it gets. " +
  "In a fast layer the same flux takes fewer grains, so φ is near 0 or 1 there even inside the fan.";

const ANY: Record<string, string> = {
  "t_c": "The first wave of the start reaches the interface. Until then the layer beyond does not know of it.",
  "t_0": "The first wave of the start reaches the bottom, which lets nothing through: from here on a shock grows there.",
  "t_1": "The first wave of the start reaches the top, which lets nothing through: from here on a shock grows there.",
  "t^_c": "The last shock has passed the interface: from here on the flux through it is 0.",
  "t*": "The last shocks have met, and each height has what it keeps.",
};

export function whyOf(scene: Scene, picture: Picture, m: NamedTime): string {
  if (m.t === 0 && m.formula !== "t*") return `What lies here at the start moves at once: ${isOfGrains(scene) ? "both kinds of grains are there" : "its flux is not 0"}.`;
  const words = (isInverse(scene) ? GRAINS[m.formula] : undefined) ?? ANY[m.formula] ?? "";
  return words + sumOfLayers(scene, m) + (m.formula === "t_1" && isInverse(scene) ? mixingInWords(picture, m.t) : "");
}

function mixingInWords(picture: Picture, t: number): string {
  const at = mixingAt(picture, t);
  if (!at) return "";
  const when = at.isRising ? "still rising at the end of the picture" : `largest, ${at.most.toFixed(2)}, at t = ${brief(Number(at.tMost.toPrecision(2)))}`;
  const psi = at.isRising ? `it is ${when}` : at.tMost > t ? `it is ${when}, as the fan still flattens until the shocks take away more than that adds` : `it was ${when}`;
  return `${at.psi > 0.85 * at.most ? " " + MIXED : ""} The mixing Ψ is ${at.psi.toFixed(2)} at t_1; ${psi}.`;
}
