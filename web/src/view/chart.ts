// SPDX-License-Identifier: BSD-3-Clause
// Small charts of their own axes: curves and dots on linear or logarithmic scales.
import { scaleLinear, scaleLog, type ScaleLinear, type ScaleLogarithmic } from "d3-scale";
import { drawXAxis, drawYAxis, type Frame } from "./axes.ts";
import { join, path, set, svg } from "./svg.ts";

export interface Series {
  key: string;
  class: string;
  points: readonly (readonly [number, number])[];
  line?: boolean;
  dots?: number; // radius
}

export interface ChartOptions {
  width: number;
  height: number;
  xTitle: string;
  yTitle: string;
  x: [number, number];
  y: [number, number];
  logX?: boolean;
  logY?: boolean;
  left?: number;
  label: string;
}

export class Chart {
  readonly element = svg("svg", { role: "img", class: "chart" });
  private readonly groups = { series: svg("g"), x: svg("g"), y: svg("g"), marks: svg("g") };
  x: ScaleLinear<number, number> | ScaleLogarithmic<number, number> = scaleLinear();
  y: ScaleLinear<number, number> | ScaleLogarithmic<number, number> = scaleLinear();

  constructor() {
    this.element.append(this.groups.series, this.groups.x, this.groups.y, this.groups.marks);
  }

  draw(o: ChartOptions, series: readonly Series[], texts: readonly { x: number; y: number; text: string; class?: string }[] = []): void {
    const frame: Frame = { width: o.width, height: o.height, left: o.left ?? 52, right: 12, top: 20, bottom: 34 };
    set(this.element, { viewBox: `0 0 ${o.width} ${o.height}`, width: o.width, height: o.height, "aria-label": o.label });
    this.x = (o.logX ? scaleLog() : scaleLinear()).domain(o.x).range([frame.left, o.width - frame.right]);
    this.y = (o.logY ? scaleLog() : scaleLinear()).domain(o.y).range([o.height - frame.bottom, frame.top]);
    const place = ([x, y]: readonly [number, number]): [number, number] => [this.x(x), this.y(y)];
    join(this.groups.series, series, (s) => s.key, () => svg("g"), (g, s) => {
      set(g, { class: s.class });
      g.replaceChildren();
      if (s.line !== false) g.append(svg("path", { d: path(s.points.map(place)) }));
      if (s.dots) for (const p of s.points) g.append(svg("circle", { cx: place(p)[0], cy: place(p)[1], r: s.dots }));
    });
    join(this.groups.marks, texts, (t) => t.text, () => svg("text"), (e, t) => {
      set(e, { x: this.x(t.x) + 6, y: this.y(t.y) - 6, class: t.class ?? "note" });
      e.textContent = t.text;
    });
    drawXAxis(this.groups.x, frame, this.x, o.xTitle, o.logX ? 4 : undefined);
    drawYAxis(this.groups.y, frame, this.y, o.yTitle, o.logY ? 4 : undefined);
  }
}
