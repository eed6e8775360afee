// SPDX-License-Identifier: BSD-3-Clause
// What can be done to a bed: each edit gives a new scene, valid if the old one was.
import { bottomOf, fluxOf, hasSteps, number, numbers, rateModel, type Scene, scaleOf, type Table, table, topOf, type Value, withTable, without } from "./scene.ts";

const clamp = (x: number, low: number, high: number): number => Math.min(high, Math.max(low, x));

/** Rounded to a step that a drag can aim at: three digits of the size. */
export function tidy(x: number, size: number): number {
  const step = 10 ** (Math.floor(Math.log10(Math.abs(size) || 1)) - 3);
  return Number((Math.round(x / step) * step).toPrecision(12));
}

/** z kept between its neighbours. */
function between(scene: Scene, breaks: number[], i: number, z: number): number {
  const bottom = bottomOf(scene);
  const top = topOf(scene);
  const gap = (top - bottom) / 500;
  const low = (i > 0 ? breaks[i - 1]! : bottom) + gap;
  const high = (i + 1 < breaks.length ? breaks[i + 1]! : top) - gap;
  return tidy(clamp(z, low, high), top - bottom);
}

function moved(scene: Scene, key: string, i: number, z: number): Scene {
  const breaks = numbers(table(scene, key), "breaks");
  return withTable(scene, key, { breaks: breaks.map((b, k) => (k === i ? between(scene, breaks, i, z) : b)) });
}
export const moveInterface = (scene: Scene, i: number, z: number): Scene => moved(scene, "shear_rate", i, z);
export const moveJump = (scene: Scene, i: number, z: number): Scene => moved(scene, "initial", i, z);

/** Layer i gets the speed s a, which the panel shows. */
export function setLayerSpeed(scene: Scene, i: number, speed: number): Scene {
  const values = numbers(table(scene, "shear_rate"), "values");
  const size = Math.max(...values);
  const rate = Math.max(tidy(speed / scaleOf(scene), size), size * 1e-3);
  return withTable(scene, "shear_rate", { values: values.map((v, k) => (k === i ? rate : v)) });
}

export function setState(scene: Scene, i: number, phi: number, low: number, high: number): Scene {
  const values = numbers(table(scene, "initial"), "values");
  const state = clamp(tidy(phi, high - low), low, high);
  return withTable(scene, "initial", { values: values.map((v, k) => (k === i ? state : v)) });
}

/** A piece between breaks, and its middle. */
function middleOf(scene: Scene, breaks: number[], i: number): { i: number; z: number } {
  const edges = [bottomOf(scene), ...breaks, topOf(scene)];
  return { i, z: tidy((edges[i]! + edges[i + 1]!) / 2, edges.at(-1)! - edges[0]!) };
}

function widest(scene: Scene, breaks: number[]): { i: number; z: number } {
  const edges = [bottomOf(scene), ...breaks, topOf(scene)];
  let i = 0;
  for (let k = 1; k + 1 < edges.length; ++k) if (edges[k + 1]! - edges[k]! > edges[i + 1]! - edges[i]! + 1e-12) i = k;
  return middleOf(scene, breaks, i);
}

function inserted<T>(xs: T[], at: number, x: T): T[] {
  return [...xs.slice(0, at), x, ...xs.slice(at)];
}

/** Cuts layer i in two, or else the thickest; the upper part moves at 0.6 of its rate. */
export function addLayer(scene: Scene, layer?: number): Scene {
  const rate = table(scene, "shear_rate");
  const breaks = numbers(rate, "breaks");
  const values = numbers(rate, "values");
  const { i, z } = layer === undefined ? widest(scene, breaks) : middleOf(scene, breaks, layer);
  return withTable(scene, "shear_rate", {
    breaks: inserted(breaks, i, z),
    values: inserted(values, i + 1, tidy(values[i]! * 0.6, values[i]!)),
  });
}

export function removeLayer(scene: Scene, i: number): Scene {
  const rate = table(scene, "shear_rate");
  const breaks = numbers(rate, "breaks");
  if (breaks.length === 0) return scene;
  return withTable(scene, "shear_rate", {
    breaks: breaks.filter((_, k) => k !== Math.max(0, i - 1)),
    values: numbers(rate, "values").filter((_, k) => k !== i),
  });
}

/** Cuts the widest piece of the start; above the new jump stands the other side of the range. */
export function addJump(scene: Scene, low: number, high: number): Scene {
  const start = table(scene, "initial");
  const breaks = numbers(start, "breaks");
  const values = numbers(start, "values");
  const { i, z } = widest(scene, breaks);
  return withTable(scene, "initial", {
    breaks: inserted(breaks, i, z),
    values: inserted(values, i + 1, tidy(low + high - values[i]!, high - low)),
  });
}

export function removeJump(scene: Scene, i: number): Scene {
  const start = table(scene, "initial");
  return withTable(scene, "initial", {
    breaks: numbers(start, "breaks").filter((_, k) => k !== i),
    values: numbers(start, "values").filter((_, k) => k !== i + 1),
  });
}

/** First entries of each flux, and the states it knows. */
interface FluxFacts {
  entries: Table;
  range: [number, number];
  needsOpenEnds?: true;
  needsOneRate?: true; // no interface can carry it
}
const FLUXES: Record<string, FluxFacts> = {
  quadratic: { entries: {}, range: [0, 1] },
  cubic: { entries: { gamma: 0.9 }, range: [0, 1] },
  lwr: { entries: { jam: 1 }, range: [0, 1] },
  "lwr-cubic": { entries: { jam: 1, gamma: 0.5 }, range: [0, 1] },
  triangular: { entries: { critical: 0.3, jam: 1 }, range: [0, 1] },
  "richardson-zaki": { entries: { exponent: 4.65 }, range: [0, 1] },
  "buckley-leverett": { entries: { viscosity_ratio: 0.5 }, range: [0, 1], needsOpenEnds: true },
  burgers: { entries: { lowest: -1, highest: 1 }, range: [-1, 1], needsOpenEnds: true, needsOneRate: true },
  table: { entries: { phi: [0, 0.25, 0.5, 0.75, 1], values: [0, -0.2, -0.25, -0.12, 0] }, range: [0, 1] },
};
export const FLUX_NAMES = Object.keys(FLUXES);
export const needsOpenEnds = (model: string): boolean => FLUXES[model]?.needsOpenEnds ?? false;

export const needsOneRate = (model: string): boolean => FLUXES[model]?.needsOneRate ?? false;

/** Another flux for the whole bed; states are carried over to its range, walls opened where it has none. */
export function setFlux(scene: Scene, model: string): Scene {
  const before = FLUXES[String(fluxOf(scene)["model"] ?? "quadratic")]?.range ?? [0, 1];
  const { entries, range } = FLUXES[model] ?? FLUXES["quadratic"]!;
  const carried = (x: number): number =>
    tidy(range[0] + ((x - before[0]) / (before[1] - before[0])) * (range[1] - range[0]), range[1] - range[0]);
  let changed: Scene = { ...scene, flux: { model, ...entries } };
  if (hasSteps(scene))
    changed = withTable(changed, "initial", { values: numbers(table(scene, "initial"), "values").map((v) => clamp(carried(v), ...range)) });
  if (needsOneRate(model)) changed = { ...changed, shear_rate: { model: "piecewise", breaks: [], values: [numbers(table(scene, "shear_rate"), "values")[0] ?? 1] } };
  if (needsOpenEnds(model) && endsOf(scene) === "walls") return setEnds(changed, "open");
  return endsOf(scene) === "open" ? setEnds(changed, "open") : changed;
}

export function setFluxEntry(scene: Scene, key: string, value: Value): Scene {
  return { ...scene, flux: { ...fluxOf(scene), [key]: value } };
}

export type Ends = "walls" | "open" | "periodic";
export function endsOf(scene: Scene): Ends {
  const boundary = table(scene, "boundary");
  return boundary["periodic"] === true ? "periodic" : boundary["bottom"] || boundary["top"] ? "open" : "walls";
}

/** Open ends begin with the states inside next to them. */
export function setEnds(scene: Scene, ends: Ends): Scene {
  if (ends === "walls") return without(scene, "boundary");
  if (ends === "periodic") return { ...scene, boundary: { periodic: true } };
  const values = numbers(table(scene, "initial"), "values");
  return { ...scene, boundary: { bottom: { values: [values[0] ?? 0] }, top: { values: [values.at(-1) ?? 0] } } };
}

export function setOutside(scene: Scene, end: "bottom" | "top", i: number, value: number): Scene {
  const boundary = table(scene, "boundary");
  const outside = (boundary[end] as Table) ?? { values: [0] };
  const values = numbers(outside, "values").map((v, k) => (k === i ? value : v));
  return { ...scene, boundary: { ...boundary, [end]: { ...outside, values } } };
}

/** Another kind of a(z), about as fast as the one before. `speeds` are s a at the bottom and at the top. */
export function setRateModel(scene: Scene, model: string, speeds: { z: number; speed: number }[]): Scene {
  if (model === rateModel(scene)) return scene;
  const bottom = bottomOf(scene);
  const height = topOf(scene) - bottom;
  const first = speeds[0]!.speed;
  const last = speeds.at(-1)!.speed;
  const mean = tidy(speeds.reduce((sum, s) => sum + s.speed, 0) / speeds.length, first);
  if (model === "exponential") {
    const drop = Math.max(Math.abs(Math.log(first / last)), 0.5);
    const decay = tidy(height / drop, height);
    return { ...scene, shear_rate: { model, amplitude: tidy(Math.max(first, last) * Math.exp(bottom / decay), first), decay } };
  }
  if (model === "table") {
    const points = speeds.filter((_, i) => i % Math.ceil(speeds.length / 8) === 0 || i + 1 === speeds.length);
    return { ...scene, shear_rate: { model, z: points.map((p) => tidy(p.z, height)), values: points.map((p) => tidy(p.speed, first)) } };
  }
  return { ...scene, shear_rate: { model: "piecewise", breaks: [tidy(bottom + height / 2, height)], values: [tidy((first + mean) / 2, first), tidy((last + mean) / 2, first)] } };
}

export function setRateEntry(scene: Scene, key: string, value: Table[string]): Scene {
  return withTable(scene, "shear_rate", { [key]: value });
}

/** The point i of a table of a(z). */
export function movePoint(scene: Scene, i: number, speed: number): Scene {
  const values = numbers(table(scene, "shear_rate"), "values");
  const size = Math.max(...values);
  const rate = Math.max(tidy(speed / scaleOf(scene), size), size * 1e-3);
  return setRateEntry(scene, "values", values.map((v, k) => (k === i ? rate : v)));
}

/** a(z) as drawn by hand: speeds at heights, in any order, become a table of at most n points from end to end. */
export function drawnRate(scene: Scene, stroke: { z: number; speed: number }[], n = 13): Scene {
  const bottom = bottomOf(scene);
  const top = topOf(scene);
  const sorted = [...stroke].sort((a, b) => a.z - b.z);
  if (sorted.length < 2) return scene;
  const size = Math.max(...sorted.map((p) => p.speed));
  const z = Array.from({ length: n }, (_, k) => tidy(bottom + ((top - bottom) * k) / (n - 1), top - bottom));
  const values = z.map((height) => {
    const after = sorted.findIndex((p) => p.z >= height);
    const b = after < 0 ? sorted.at(-1)! : sorted[after]!;
    const a = after <= 0 ? b : sorted[after - 1]!;
    const share = b.z > a.z ? (height - a.z) / (b.z - a.z) : 0;
    return Math.max(tidy((a.speed + share * (b.speed - a.speed)) / scaleOf(scene), size), size * 1e-3);
  });
  const scale = scaleOf(scene);
  return { ...scene, shear_rate: { model: "table", z, values, ...(scale === 1 ? {} : { scale }) } };
}

/** An exponential a(z) through the speed at a height, its decay or its amplitude kept. */
export function bendExponential(scene: Scene, z: number, speed: number, keeps: "decay" | "amplitude"): Scene {
  const rate = table(scene, "shear_rate");
  const decay = number(rate, "decay", 1);
  const amplitude = number(rate, "amplitude", 1);
  const a = Math.max(speed / scaleOf(scene), amplitude * 1e-3);
  if (keeps === "decay") return setRateEntry(scene, "amplitude", tidy(a * Math.exp(z / decay), amplitude));
  const height = topOf(scene) - bottomOf(scene);
  const drop = Math.log(amplitude / a);
  return setRateEntry(scene, "decay", clamp(tidy(z / Math.max(drop, z / (50 * height)), height), height / 50, height * 50));
}
