// SPDX-License-Identifier: BSD-3-Clause
// Axes of a panel: ticks, numbers, title.
import { format } from "d3-format";
import { scaleLinear, type ScaleLinear, type ScaleLogarithmic } from "d3-scale";
import { join, set, svg } from "./svg.ts";

type Scale = ScaleLinear<number, number> | ScaleLogarithmic<number, number>;

export interface Frame {
  width: number;
  height: number;
  left: number;
  right: number;
  top: number;
  bottom: number;
}

const short = format(".2~g");

interface Tick {
  value: number;
  text: string;
}

/** On a logarithmic scale the powers of ten, and 2 and 5 where there are few. */
function ticks(scale: Scale, n: number): Tick[] {
  const isLog = "base" in scale;
  const values = scale.ticks(n);
  if (!isLog) {
    const usual = scale.tickFormat(n);
    const isLong = values.some((value) => usual(value).length > 7);
    return values.map((value) => ({ value, text: (isLong ? short(value) : usual(value)).replace("−", "-") }));
  }
  const lead = (x: number): number => Math.round(x / 10 ** Math.floor(Math.log10(x) + 1e-9));
  const powers = values.filter((x) => lead(x) === 1);
  const shown = powers.length >= 2 ? powers : values.filter((x) => [1, 2, 5].includes(lead(x)));
  return shown.map((value) => ({ value, text: value >= 1e-2 && value < 1e4 ? String(Number(value.toPrecision(2))) : value.toExponential(0) }));
}

const rowsOf = (height: number): number => Math.max(1, height / 60);

/** Letters of the longest number of an axis upwards. */
export function widestTick(low: number, high: number, height: number): number {
  return Math.max(...ticks(scaleLinear().domain([low, high]), rowsOf(height)).map((t) => t.text.length));
}

export function drawXAxis(group: SVGGElement, frame: Frame, x: Scale, title: string, n: number = Math.max(2, (frame.width - frame.left) / 80)): void {
  const y = frame.height - frame.bottom;
  set(group, { class: "axis", "aria-hidden": "true" });
  join(group, [...ticks(x, n), { value: NaN, text: title }], (t) => (Number.isNaN(t.value) ? "title" : String(t.value)), () => svg("g"), (g, t) => {
    g.replaceChildren();
    if (Number.isNaN(t.value)) {
      g.append(svg("line", { x1: frame.left, x2: frame.width - frame.right, y1: y, y2: y }));
      if (t.text) g.append(svg("text", { x: (frame.left + frame.width - frame.right) / 2, y: frame.height - 3, "text-anchor": "middle", class: "title" }, t.text));
      return;
    }
    const at = x(t.value);
    g.append(svg("line", { x1: at, x2: at, y1: y, y2: y + 4 }));
    if (t.text) g.append(svg("text", { x: at, y: y + 16, "text-anchor": "middle" }, t.text));
  });
}

export function drawYAxis(group: SVGGElement, frame: Frame, y: Scale, title: string, n = rowsOf(frame.height)): void {
  set(group, { class: "axis", "aria-hidden": "true" });
  join(group, [...ticks(y, n), { value: NaN, text: title }], (t) => (Number.isNaN(t.value) ? "title" : String(t.value)), () => svg("g"), (g, t) => {
    g.replaceChildren();
    if (Number.isNaN(t.value)) {
      g.append(svg("line", { x1: frame.left, x2: frame.left, y1: frame.top, y2: frame.height - frame.bottom }));
      if (t.text) g.append(svg("text", { x: 4, y: 12, class: "title" }, t.text));
      return;
    }
    const at = y(t.value);
    g.append(svg("line", { x1: frame.left - 4, x2: frame.left, y1: at, y2: at }));
    if (t.text) g.append(svg("text", { x: frame.left - 7, y: at + 4, "text-anchor": "end" }, t.text));
  });
}
