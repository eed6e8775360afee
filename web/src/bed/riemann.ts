// SPDX-License-Identifier: BSD-3-Clause
// The Riemann problem of a collision, as its fronts tell it: what came in, what goes out, in the flux plane.
import type { Collision, Engine, Front, SceneFacts } from "../engine/engine.ts";

export interface Chord {
  below: number;
  above: number;
  speed: number;
  side: "below" | "above"; // of the interface where it runs
  strength: number;
}

export interface RiemannProblem {
  incoming: Chord[];
  outgoing: Chord[];
  /** The flux as a function of phi on both sides; the same one inside a layer. */
  below: { phi: number; flux: number }[];
  above: { phi: number; flux: number }[];
  isInterface: boolean;
  isWall: boolean;
}

const near = (a: number, b: number, size: number): boolean => Math.abs(a - b) <= 1e-9 * size;

export function riemannProblem(engine: Engine, facts: SceneFacts, fronts: readonly Front[], collision: Collision): RiemannProblem {
  const height = facts.top - facts.bottom;
  const { t, z } = collision;
  const size = Math.max(t, 1e-300);
  const isWall = near(z, facts.bottom, height) || near(z, facts.top, height);
  const isInterface = !isWall && collision.boundary >= 0;
  const step = 1e-7 * height;
  const curve = (at: number): { phi: number; flux: number }[] => engine.flux(Math.min(facts.top, Math.max(facts.bottom, at)), 160);
  const chord = (f: Front, isIncoming: boolean): Chord => {
    const duration = f.tEnd - f.tBegin;
    const speed = duration > 0 ? (f.zEnd - f.zBegin) / duration : 0;
    // What comes in from below has run upwards, what goes out below runs downwards.
    const side = (isIncoming ? speed > 0 : speed < 0) ? "below" : "above";
    return { below: f.below, above: f.above, speed, side, strength: Math.abs(f.above - f.below) };
  };
  const at = (ft: number, fz: number): boolean => near(ft, t, size) && near(fz, z, height);
  return {
    incoming: fronts.filter((f) => at(f.tEnd, f.zEnd) && f.tBegin < t).map((f) => chord(f, true)).sort((a, b) => b.speed - a.speed),
    outgoing: fronts.filter((f) => at(f.tBegin, f.zBegin) && f.tEnd > t).map((f) => chord(f, false)).sort((a, b) => a.speed - b.speed),
    below: curve(z - step), above: curve(z + step), isInterface, isWall,
  };
}

/** The flux of a state, on a curve. */
export function fluxAt(curve: readonly { phi: number; flux: number }[], phi: number): number {
  const after = curve.findIndex((p) => p.phi >= phi);
  if (after <= 0) return curve[Math.max(0, after)]?.flux ?? 0;
  const [a, b] = [curve[after - 1]!, curve[after]!];
  return a.flux + ((b.flux - a.flux) * (phi - a.phi)) / (b.phi - a.phi);
}
