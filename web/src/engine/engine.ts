// SPDX-License-Identifier: BSD-3-Clause
// What the engine can be asked, with names for its numbers.
import { Refusal, Wasm, type Watch } from "./wasm.ts";

export { Refusal };

export interface SceneFacts {
  bottom: number;
  top: number;
  lowest: number; // states of the flux
  highest: number;
  isLayered: boolean;
  hasWalls: boolean;
  diffuses: boolean;
  isBed: boolean; // neither a chute nor a slab
  knots: number[];
  name: string;
  remarks: string[];
}

export interface InterfaceTimes {
  z: number;
  first: number;
  last: number;
  jumps: boolean; // false: only the slope of the bed does
}

/** A time that never comes is NaN. */
export interface EventTimes {
  t0: number;
  t1: number;
  tStar: number;
  mass: number;
  steadyHeight: number;
  interfaces: InterfaceTimes[];
  message: string;
}

export interface Front {
  layer: number;
  tBegin: number;
  zBegin: number;
  tEnd: number;
  zEnd: number;
  below: number;
  above: number;
}

export interface Collision {
  t: number;
  z: number;
  boundary: number; // 0 the bottom, then interfaces, then the top; -1 inside a layer
  incoming: number;
  outgoing: number;
}

export interface Pieces {
  l1: number; // to the exact solution; NaN if there is none
  work: number;
  pieces: Float64Array; // z below, z above, phi below, phi above of each
}

export interface Samples {
  phi: Float64Array; // [time * heights + height]
  M: Float64Array;
  remark: string;
}

export interface ObservedRow {
  t: number;
  z: number;
  value: number;
  width: number;
  sigma: number;
}

export interface ObservedData {
  quantity: string;
  understood: string;
  notes: string[];
  rows: ObservedRow[];
}

export interface FittedParameter {
  name: string;
  start: number;
  estimate: number;
  error: number;
  low: number;
  high: number;
  profileLow: number;
  profileHigh: number;
  atBound: boolean;
}

export interface Estimate {
  status: string;
  message: string;
  quantity: string;
  loss: string;
  misfit: number;
  residualNorm: number;
  sigma: number;
  observations: number;
  leftOut: number;
  evaluations: number;
  iterations: number;
  parameters: FittedParameter[];
  correlation: number[][];
  predicted: Float64Array;
  warnings: string[];
}

const lines = (text: string): string[] => text.split("\n").slice(0, -1);

/** Cuts numbers into groups of n. */
function* groups(numbers: Float64Array, n: number): Generator<Float64Array> {
  for (let i = 0; i + n <= numbers.length; i += n) yield numbers.subarray(i, i + n);
}

export class Engine {
  private readonly wasm: Wasm;
  constructor(module: WebAssembly.Module) {
    this.wasm = new Wasm(module);
  }

  /** Everything below is of this scene. Throws Refusal with all complaints. */
  setScene(toml: string): SceneFacts {
    const { numbers, text } = this.wasm.call("sf_scene", toml);
    const [name = "", ...remarks] = lines(text);
    const [bottom, top, lowest, highest, isLayered, hasWalls, diffuses, isOther, ...knots] = Array.from(numbers) as [
      number, number, number, number, number, number, number, number, ...number[],
    ];
    return {
      bottom, top, lowest, highest, knots, name, remarks,
      isLayered: isLayered > 0, hasWalls: hasWalls > 0, diffuses: diffuses > 0, isBed: !(isOther > 0),
    };
  }

  refusal(method: string): string {
    return this.wasm.call("sf_refusal", method).text;
  }

  events(method: string): EventTimes {
    const { numbers, text } = this.wasm.call("sf_events", method);
    const [t0, t1, tStar, mass, steadyHeight] = numbers as unknown as [number, number, number, number, number];
    const interfaces = Array.from(groups(numbers.subarray(5), 4), ([z, first, last, jumps]) => ({
      z: z!, first: first!, last: last!, jumps: jumps! > 0,
    }));
    return { t0, t1, tStar, mass, steadyHeight, interfaces, message: text };
  }

  solve(method: string, times: ArrayLike<number>, heights: ArrayLike<number>): Samples {
    const { numbers, text } = this.wasm.call("sf_solve", method, Float64Array.from(times), Float64Array.from(heights));
    const half = numbers.length / 2;
    return { phi: numbers.subarray(0, half), M: numbers.subarray(half), remark: text };
  }

  /** Psi at the times: 0 segregated, 1 uniform. */
  mixing(method: string, times: ArrayLike<number>): Float64Array {
    return this.wasm.call("sf_mixing", method, Float64Array.from(times)).numbers;
  }

  pieces(method: string, t: number, withError: boolean): Pieces {
    const { numbers } = this.wasm.call("sf_profile", method, t, withError ? 1 : 0);
    return { l1: numbers[0]!, work: numbers[1]!, pieces: numbers.subarray(2) };
  }

  fronts(resolution: number, tEnd: number): { fronts: Front[]; collisions: Collision[] } {
    const { numbers } = this.wasm.call("sf_fronts", resolution, tEnd);
    const n = numbers[0]!;
    const fronts = Array.from(groups(numbers.subarray(1, 1 + 7 * n), 7), (f) => ({
      layer: f[0]!, tBegin: f[1]!, zBegin: f[2]!, tEnd: f[3]!, zEnd: f[4]!, below: f[5]!, above: f[6]!,
    }));
    const collisions = Array.from(groups(numbers.subarray(1 + 7 * n), 5), (c) => ({
      t: c[0]!, z: c[1]!, boundary: c[2]!, incoming: c[3]!, outgoing: c[4]!,
    }));
    return { fronts, collisions };
  }

  /** s a sqrt(T) and c at heights. */
  rates(heights: ArrayLike<number>): { rate: Float64Array; solid: Float64Array } {
    const { numbers } = this.wasm.call("sf_rates", Float64Array.from(heights));
    const half = numbers.length / 2;
    return { rate: numbers.subarray(0, half), solid: numbers.subarray(half) };
  }

  /** The flux through a height as a function of phi. */
  flux(z: number, n: number): { phi: number; flux: number }[] {
    return Array.from(groups(this.wasm.call("sf_flux", z, n).numbers, 2), ([phi, flux]) => ({ phi: phi!, flux: flux! }));
  }

  fluxes(): { name: string; formula: string; states: string }[] {
    return lines(this.wasm.call("sf_fluxes").text).map((line) => {
      const [name = "", formula = "", states = ""] = line.split("\t");
      return { name, formula, states };
    });
  }

  setObservations(csv: string): ObservedData {
    const { numbers, text } = this.wasm.call("sf_observations", csv);
    const [quantity = "", understood = "", ...notes] = lines(text);
    const rows = Array.from(groups(numbers, 5), ([t, z, value, width, sigma]) => ({
      t: t!, z: z!, value: value!, width: width!, sigma: sigma!,
    }));
    return { quantity, understood, notes, rows };
  }

  predict(fitToml: string): Float64Array {
    return this.wasm.call("sf_predict", fitToml).numbers;
  }

  fit(fitToml: string, watch: Watch): Estimate {
    this.wasm.watch = watch;
    const { numbers, text } = this.wasm.call("sf_fit", fitToml);
    const [misfit, residualNorm, sigma, observations, leftOut, evaluations, iterations, n] = Array.from(
      numbers.subarray(0, 8),
    ) as [number, number, number, number, number, number, number, number];
    const [status = "", message = "", quantity = "", loss = "", ...rest] = lines(text);
    const parameters = Array.from(groups(numbers.subarray(8, 8 + 8 * n), 8), (p, i) => ({
      name: rest[i] ?? "", start: p[0]!, estimate: p[1]!, error: p[2]!, low: p[3]!, high: p[4]!,
      profileLow: p[5]!, profileHigh: p[6]!, atBound: p[7]! > 0,
    }));
    const at = 8 + 8 * n;
    const correlation = Array.from({ length: n }, (_, i) => Array.from(numbers.subarray(at + i * n, at + (i + 1) * n)));
    return {
      status, message, quantity, loss, misfit, residualNorm, sigma, observations, leftOut, evaluations, iterations,
      parameters, correlation, predicted: numbers.subarray(at + n * n), warnings: rest.slice(n),
    };
  }
}
