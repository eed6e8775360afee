// SPDX-License-Identifier: BSD-3-Clause
// How well the bed is mixed over time, below the plane and on its axis.
import type { NamedTime } from "../bed/event_list.ts";
import type { Picture } from "../bed/picture.ts";
import type { Panel } from "./panel.ts";
import { join, path, set, svg } from "./svg.ts";

export function drawMixing(panel: Panel, picture: Picture, t: number, times: NamedTime[]): void {
  const { mixing } = picture;
  panel.x.domain([0, picture.tMax]);
  panel.y.domain([0, 1]);
  if (mixing.psi.length === 0) {
    set(panel.figure, { "data-empty": true });
    if (!picture.ms) panel.below.replaceChildren();
    return;
  }
  set(panel.figure, { "data-empty": undefined });
  const [low, high] = [panel.y(0), panel.y(1)];
  const line = path(mixing.t.map((time, i) => [panel.x(time), panel.y(mixing.psi[i]!)] as const));
  join(panel.below, [
    { key: "area", d: `${line}L${panel.x(mixing.t.at(-1)!)} ${low}L${panel.x(0)} ${low}Z`, class: "phi-fill" },
    { key: "line", d: line, class: "phi" },
  ], (c) => c.key, () => svg("path"), (p, c) => set(p, { d: c.d, class: c.class }));
  const seen = times.filter((m) => Number.isFinite(m.t) && m.t <= picture.tMax);
  join(panel.marks, [...seen.map((m) => ({ key: m.id, t: m.t, class: "interface" })), { key: "now", t, class: "now" }], (m) => m.key,
    () => svg("line"), (l, m) => set(l, { class: m.class, x1: panel.x(m.t), x2: panel.x(m.t), y1: low, y2: high }));
  panel.drawAxes(undefined, "");
  const best = mixing.psi.indexOf(Math.max(...mixing.psi));
  panel.svg.setAttribute("aria-label", `Mixing Psi over time: 0 segregated, 1 uniform. Largest, ${mixing.psi[best]!.toFixed(2)}, near t = ${mixing.t[best]!.toPrecision(3)}.`);
}
