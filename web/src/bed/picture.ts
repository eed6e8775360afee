// SPDX-License-Identifier: BSD-3-Clause
// What the engine says of a scene, as the panels show it.
import { type Engine, type EventTimes, type Front, type Collision, type SceneFacts } from "../engine/engine.ts";

export interface Raster {
  method: string;
  columns: number;
  rows: number;
  phi: Float64Array;
}

export interface Picture {
  facts: SceneFacts;
  /** The method that answers for numbers: the exact one wherever it can. */
  method: string;
  /** Why there are no event times; empty if there are. */
  noEvents: string;
  events: EventTimes | undefined;
  fronts: Front[];
  frontStep: number; // largest step of phi in their fans
  bend: number; // 1 for a convex flux, -1 for a concave one, 0 for others and where fronts are curved
  collisions: Collision[];
  tMax: number;
  raster: Raster;
  mixing: { t: number[]; psi: number[] };
  rate: { z: number[]; speed: number[]; solid: number[] };
  ms: number;
}

export interface Detail {
  columns: number;
  rows: number;
  resolution: number; // of the tracking that makes the plane
  frontStep: number; // of the fronts that are drawn
  mixingPoints: number;
  curvedFronts: boolean; // whether fronts are drawn where they are curved
}
/** While something is dragged; then the plane is made of fronts. */
export const COARSE: Detail = { columns: 128, rows: 64, resolution: 0.05, frontStep: 0.05, mixingPoints: 25, curvedFronts: false };
export const FINE: Detail = { columns: 320, rows: 160, resolution: 0.02, frontStep: 0.04, mixingPoints: 81, curvedFronts: true };

export function spread(low: number, high: number, n: number): number[] {
  return Array.from({ length: n }, (_, i) => low + ((high - low) * i) / (n - 1));
}
/** Middles of n equal parts. */
export function middles(low: number, high: number, n: number): number[] {
  return Array.from({ length: n }, (_, i) => low + ((high - low) * (i + 0.5)) / n);
}

/** Times of the columns of a raster; the first is a little after 0, where phi is the start's. */
export const columnTimes = (tMax: number, n: number): number[] => middles(0, tMax, n);

function bestMethod(engine: Engine): string {
  const all = ["exact", "front-tracking", "crank-nicolson cells=200", "godunov cells=200"];
  return all.find((name) => !engine.refusal(name)) ?? all[0]!;
}

/** The method whose raster is quick enough to be dragged. */
function quickMethod(engine: Engine, best: string, resolution: number): string {
  const tracked = `front-tracking resolution=${resolution} reconstruct=linear max-collisions=30000`;
  if (!engine.refusal(tracked)) return tracked;
  const constant = `front-tracking resolution=${resolution} max-collisions=30000`;
  return engine.refusal(constant) ? best : constant;
}

/** Speeds s a over heights, with both values where it jumps. */
function rateCurve(engine: Engine, facts: SceneFacts): Picture["rate"] {
  const height = facts.top - facts.bottom;
  const tiny = height * 1e-9;
  const edges = [facts.bottom, ...facts.knots, facts.top];
  const z = edges.slice(0, -1).flatMap((low, i) => {
    const high = edges[i + 1]!;
    const n = facts.isLayered ? 2 : Math.max(2, Math.round((60 * (high - low)) / height));
    return spread(low + (i > 0 ? tiny : 0), high - (i + 2 < edges.length ? tiny : 0), n);
  });
  const { rate, solid } = engine.rates(z);
  return { z, speed: Array.from(rate), solid: Array.from(solid) };
}

/** Which way the flux bends: in every layer, as they may have fluxes of their own. */
function bendOf(engine: Engine, facts: SceneFacts): number {
  const edges = [facts.bottom, ...facts.knots, facts.top];
  let [low, high] = [0, 0];
  for (let k = 0; k + 1 < edges.length; ++k) {
    const flux = engine.flux((edges[k]! + edges[k + 1]!) / 2, 32).map((p) => p.flux);
    const size = Math.max(...flux) - Math.min(...flux) || 1;
    for (let i = 1; i + 1 < flux.length; ++i) {
      const bend = (flux[i - 1]! - 2 * flux[i]! + flux[i + 1]!) / size;
      [low, high] = [Math.min(low, bend), Math.max(high, bend)];
    }
  }
  return low > -1e-9 ? 1 : high < 1e-9 ? -1 : 0;
}

/** How long there is something to see: a little more than t*, or while a wave crosses the bed a few times. */
export function naturalTime(events: EventTimes | undefined, facts: SceneFacts, speeds: readonly number[]): number {
  const end = events?.tStar ?? NaN;
  const times = [events?.t0, events?.t1, ...(events?.interfaces ?? []).flatMap((i) => [i.first, i.last])].filter((t): t is number => Number.isFinite(t));
  const nice = (t: number): number => Number(t.toPrecision(2));
  if (Number.isFinite(end) && end > 0) return nice(end * 1.08);
  if (times.length > 0 && Math.max(...times) > 0) return nice(Math.max(...times) * 1.3);
  const mean = speeds.reduce((sum, x) => sum + x, 0) / speeds.length;
  return nice((2 * (facts.top - facts.bottom)) / mean);
}

/** All of it, with a plane as fine as `detail`; tMax is kept if it is given. Throws Refusal for a scene that is none. */
export function makePicture(engine: Engine, toml: string, detail: Detail, tMax?: number): Picture {
  const begin = performance.now();
  const facts = engine.setScene(toml);
  const method = bestMethod(engine);
  let events: EventTimes | undefined;
  let noEvents = "";
  try {
    const of = method === "exact" ? method : `front-tracking resolution=${detail.resolution} max-collisions=200000`;
    events = engine.events(of);
  } catch (error) {
    noEvents = (error as Error).message.replace(/^method = [^;]*; /, "");
  }
  const rate = rateCurve(engine, facts);
  const end = tMax ?? naturalTime(events, facts, rate.speed);
  const quick = quickMethod(engine, method, facts.isLayered ? detail.resolution : COARSE.resolution);
  const heights = middles(facts.bottom, facts.top, detail.rows);
  let raster: Raster;
  try {
    raster = { method: quick, columns: detail.columns, rows: detail.rows, phi: engine.solve(quick, columnTimes(end, detail.columns), heights).phi };
  } catch {
    raster = { method, columns: detail.columns, rows: detail.rows, phi: engine.solve(method, columnTimes(end, detail.columns), heights).phi };
  }
  // Curved fronts are drawn as many short segments, which take longer than the plane itself.
  let fronts: Front[] = [];
  let collisions: Collision[] = [];
  if (quick.startsWith("front") && (facts.isLayered || detail.curvedFronts)) {
    try {
      ({ fronts, collisions } = engine.fronts(detail.frontStep, end));
    } catch {
      // No fronts are drawn; the plane has them in its colours.
    }
  }
  let psi: number[] = [];
  const t = spread(0, end, Math.max(2, detail.mixingPoints));
  if (detail.mixingPoints > 0 && facts.hasWalls && facts.lowest === 0 && facts.highest === 1) {
    try {
      psi = Array.from(engine.mixing(quick, t));
    } catch {
      // Not every method integrates.
    }
  }
  return {
    facts, method, events, noEvents, fronts, collisions, frontStep: detail.frontStep, bend: facts.isBed && facts.isLayered ? bendOf(engine, facts) : 0, tMax: end, raster,
    mixing: { t: psi.length > 0 ? t : [], psi }, rate, ms: performance.now() - begin,
  };
}

/** phi over z at one time, fine enough for the profile, by the method that answers for numbers. */
export function profileAt(engine: Engine, picture: Picture, t: number, n = 241): { z: number[]; phi: Float64Array; M: Float64Array } {
  const z = spread(picture.facts.bottom, picture.facts.top, n);
  const { phi, M } = engine.solve(picture.method, [t], z);
  return { z, phi, M };
}
