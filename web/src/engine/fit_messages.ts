// SPDX-License-Identifier: BSD-3-Clause
// What the page and the worker of fits say to each other.
import type { Estimate } from "./engine.ts";

export interface FitTask {
  module: WebAssembly.Module;
  scene: string;
  observations: string;
  fit: string;
}

export type FitNews =
  | { kind: "step"; evaluations: number; misfit: number; values: Float64Array }
  | { kind: "done"; estimate: Estimate; seconds: number }
  | { kind: "refused"; why: string };
