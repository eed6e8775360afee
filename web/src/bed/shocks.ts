// SPDX-License-Identifier: BSD-3-Clause
// Which fronts are shocks, and which stand for waves of a fan.
import type { Picture } from "./picture.ts";

const placeOf = (t: number, z: number): string => `${t.toPrecision(9)} ${z.toPrecision(9)}`;

/** Curved fronts are drawn as many segments. Shocks are wide and long, as steps across the extremum of the flux are wide, but short; and what goes on alone from one. */
function curvedShocks(fronts: Picture["fronts"], width: number, tMax: number): Picture["fronts"] {
  const sorted = fronts.toSorted((a, b) => a.tBegin - b.tBegin);
  const isWide = (f: Picture["fronts"][number]): boolean => Math.abs(f.above - f.below) > width;
  const spans = new Map<string, { from: number; to: number }>(); // of wide ones, by where they have come to
  const leaving = new Map<string, number>();
  const spanOf = sorted.map((f) => {
    const begin = placeOf(f.tBegin, f.zBegin);
    leaving.set(begin, (leaving.get(begin) ?? 0) + 1);
    if (!isWide(f)) return undefined;
    const span = spans.get(begin) ?? { from: f.tBegin, to: f.tEnd };
    span.to = Math.max(span.to, f.tEnd);
    spans.set(placeOf(f.tEnd, f.zEnd), span);
    return span;
  });
  const ends = new Set<string>();
  return sorted.filter((f, i) => {
    const begin = placeOf(f.tBegin, f.zBegin);
    const span = spanOf[i];
    const isShock = (span && span.to - span.from > 0.1 * tMax) || (ends.has(begin) && leaving.get(begin) === 1);
    if (isShock) ends.add(placeOf(f.tEnd, f.zEnd));
    return isShock;
  });
}

/** Where the flux bends one way only, shocks are the fronts that waves run into from both sides. Of others they are those too wide for a fan. */
export function shocksOf(picture: Picture): Picture["fronts"] {
  const states = picture.facts.highest - picture.facts.lowest;
  const { bend, fronts, frontStep, facts, tMax } = picture;
  if (bend !== 0) return fronts.filter((f) => bend * (f.below - f.above) > 0.01 * states);
  if (facts.isLayered) return fronts.filter((f) => Math.abs(f.above - f.below) > 1.5 * frontStep * states);
  return curvedShocks(fronts, 3.5 * frontStep * states, tMax);
}
