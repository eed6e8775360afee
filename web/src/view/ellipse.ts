// SPDX-License-Identifier: BSD-3-Clause
// Two estimates together: the 95 % ellipse of their covariance.
import type { Estimate } from "../engine/engine.ts";
import type { Chart } from "./chart.ts";

/** The 95 % quantile of chi squared with two degrees of freedom. */
const CHI2 = 5.991464547107979;

export function drawEllipse(chart: Chart, estimate: Estimate, i: number, j: number): void {
  const [a, b] = [estimate.parameters[i]!, estimate.parameters[j]!];
  const correlation = i === j ? 1 : estimate.correlation[i]![j]!;
  const isKnown = Number.isFinite(a.error) && Number.isFinite(b.error) && Number.isFinite(correlation);
  const radius = Math.sqrt(CHI2);
  const reach = 1.25 * radius;
  const points: [number, number][] = isKnown
    ? Array.from({ length: 97 }, (_, k) => {
        const angle = (2 * Math.PI * k) / 96;
        const [u, v] = [Math.cos(angle), Math.sin(angle)];
        return [a.estimate + radius * a.error * u, b.estimate + radius * b.error * (correlation * u + Math.sqrt(Math.max(0, 1 - correlation ** 2)) * v)];
      })
    : [];
  const span = (p: typeof a): [number, number] => {
    const error = Number.isFinite(p.error) ? p.error : Math.abs(p.estimate) / 10 || 1;
    return [p.estimate - reach * error, p.estimate + reach * error];
  };
  const [x, y] = [span(a), span(b)];
  const edge = (low: number, high: number, isX: boolean): [number, number][][] =>
    [low, high].filter(Number.isFinite).map((at) => (isX ? [[at, y[0]], [at, y[1]]] : [[x[0], at], [x[1], at]]));
  chart.draw({
    width: 320, height: 260, left: 64, xTitle: a.name, yTitle: b.name, x, y,
    label: isKnown ? `${a.name} and ${b.name}: correlation ${correlation.toFixed(2)}` : "no error bars for these two",
  }, [
    ...edge(a.low, a.high, true).map((points, k) => ({ key: `x${k}`, class: "curve zero", points })),
    ...edge(b.low, b.high, false).map((points, k) => ({ key: `y${k}`, class: "curve zero", points })),
    { key: "ellipse", class: "curve ellipse", points },
    { key: "estimate", class: "curve tracked", points: [[a.estimate, b.estimate]], line: false, dots: 4 },
  ]);
}
