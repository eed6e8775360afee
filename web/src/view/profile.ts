// SPDX-License-Identifier: BSD-3-Clause
// phi over z at the time shown, beside the start.
import type { Picture } from "../bed/picture.ts";
import type { ObservedRow } from "../engine/engine.ts";
import type { Panel } from "./panel.ts";
import { join, path, set, svg } from "./svg.ts";

export interface Curve {
  z: number[];
  phi: ArrayLike<number>;
}

export function drawProfile(panel: Panel, picture: Picture, now: Curve, start: Curve, data: ObservedRow[], title: string): void {
  const { facts } = picture;
  const margin = 0.04 * (facts.highest - facts.lowest);
  panel.x.domain([facts.lowest - margin, facts.highest + margin]);
  panel.y.domain([facts.bottom, facts.top]);
  panel.context();
  panel.drawAxes(title, "");
  const d = (curve: Curve): string => path(curve.z.map((z, i) => [panel.x(curve.phi[i]!), panel.y(z)] as const));
  const filled = d(now) + `L${panel.x(facts.lowest).toFixed(1)} ${panel.y(facts.top).toFixed(1)}L${panel.x(facts.lowest).toFixed(1)} ${panel.y(facts.bottom).toFixed(1)}Z`;
  join(panel.below, [
    { key: "fill", d: filled, class: "phi-fill" },
    { key: "start", d: d(start), class: "phi-start" },
    { key: "now", d: d(now), class: "phi" },
  ], (c) => c.key, () => svg("path"), (p, c) => set(p, { d: c.d, class: c.class }));
  join(panel.marks, data, (row) => `${row.z} ${row.t}`, () => svg("circle", { class: "datum", r: 3.2 }), (c, row) => set(c, { cx: panel.x(row.value), cy: panel.y(row.z) }));
}
