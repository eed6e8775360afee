// SPDX-License-Identifier: BSD-3-Clause
// s a(z), turned so that z runs upwards as in the other panels.
import type { Picture } from "../bed/picture.ts";
import type { Panel } from "./panel.ts";
import { join, path, set, svg } from "./svg.ts";

export function drawRate(panel: Panel, picture: Picture, highest: number, stroke: { x: number; y: number }[], title: string): void {
  const { facts, rate } = picture;
  panel.x.domain([0, highest]);
  panel.y.domain([facts.bottom, facts.top]);
  panel.context();
  panel.drawAxes(title, "");
  const d = path(rate.z.map((z, i) => [panel.x(rate.speed[i]!), panel.y(z)] as const));
  const edge = panel.x(0).toFixed(1);
  join(panel.below, [
    { key: "fill", d: d + `L${edge} ${panel.y(facts.top).toFixed(1)}L${edge} ${panel.y(facts.bottom).toFixed(1)}Z`, class: "rate-fill" },
    { key: "line", d, class: "rate" },
    { key: "stroke", d: path(stroke.map((p) => [panel.x(p.x), panel.y(p.y)] as const)), class: "stroke" },
  ], (c) => c.key, () => svg("path"), (p, c) => set(p, { d: c.d, class: c.class }));
}
