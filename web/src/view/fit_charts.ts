// SPDX-License-Identifier: BSD-3-Clause
// Residuals, and the way of a search.
import type { SceneFacts } from "../engine/engine.ts";
import type { Chart } from "./chart.ts";
import { brief } from "./numbers.ts";

/** Their root mean square. */
export function drawResiduals(chart: Chart, points: readonly (readonly [number, number])[], facts: SceneFacts): number {
  const size = Math.max(1e-9, ...points.map((p) => Math.abs(p[1])));
  const rms = Math.sqrt(points.reduce((sum, p) => sum + p[1] ** 2, 0) / Math.max(1, points.length));
  chart.draw({
    width: 320, height: 220, xTitle: "z", yTitle: `bed less data, rms ${brief(rms)}`, x: [facts.bottom, facts.top], y: [-1.1 * size, 1.1 * size],
    label: points.length > 0 ? `Residuals over height, root mean square ${brief(rms)}` : "No data yet",
  }, [{ key: "zero", class: "curve zero", points: [[facts.bottom, 0], [facts.top, 0]] }, { key: "all", class: "curve residual", points, line: false, dots: 1.8 }]);
  return rms;
}

/** Cut where the misfit rises: within a start and a stage a search only goes down. */
export function stretches(course: readonly (readonly [number, number])[]): (readonly [number, number])[][] {
  const all: (readonly [number, number])[][] = [];
  course.forEach((point, i) => {
    if (i === 0 || point[1] > course[i - 1]![1]) all.push([]);
    all.at(-1)!.push(point);
  });
  return all;
}

/** Misfits over evaluations, a curve of each stage or start. */
export function drawCourse(chart: Chart, course: readonly (readonly [number, number])[]): void {
  const xs = course.map((p) => p[0]);
  const ys = course.map((p) => p[1]);
  chart.draw({
    width: 320, height: 220, left: 58, xTitle: "evaluations", yTitle: "misfit", x: [0, Math.max(10, ...xs)],
    y: ys.length > 0 ? [Math.min(...ys) / 1.5, Math.max(...ys) * 1.5] : [1, 100], logY: true, label: "Misfit over the evaluations of the search",
  }, stretches(course).map((points, i) => ({ key: `course ${i}`, class: "curve tracked", points, dots: 3 })));
}
