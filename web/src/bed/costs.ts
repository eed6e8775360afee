// SPDX-License-Identifier: BSD-3-Clause
// What an accuracy costs a grid.

/** Grids that are measured. */
export const CELLS = [25, 50, 100, 200, 400, 800];

/** Cells and time at which the errors of a trail come down to one: straight lines between its points, and beyond them, in logarithms. */
export function fineEnough(trail: readonly [number, number][], error: number): { cells: number; ms: number } {
  const found = trail.findIndex(([, l1]) => l1 <= error);
  const i = Math.min(trail.length - 1, Math.max(1, found < 0 ? trail.length - 1 : found));
  const [[ms0, l0], [ms1, l1]] = [trail[i - 1]!, trail[i]!];
  const share = Math.log(error / l0) / Math.log(l1 / l0);
  const between = (a: number, b: number): number => a * (b / a) ** share;
  return { cells: between(CELLS[i - 1]!, CELLS[i]!), ms: between(ms0, ms1) };
}
