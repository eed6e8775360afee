// SPDX-License-Identifier: BSD-3-Clause
// The (t, z) plane: phi in colour, fronts, event times, the time shown beside it.
import type { NamedTime } from "../bed/event_list.ts";
import type { Picture, Raster } from "../bed/picture.ts";
import { shocksOf } from "../bed/shocks.ts";
import type { ObservedRow } from "../engine/engine.ts";
import { css, paint } from "./colours.ts";
import { brief } from "./numbers.ts";
import type { Panel } from "./panel.ts";
import { join, set, svg } from "./svg.ts";

export interface PlaneMarks {
  t: number;
  times: NamedTime[];
  data: { rows: ObservedRow[]; quantity: string };
  collision: { t: number; z: number } | undefined;
  showFronts: boolean;
  labels: { x: string; y: string };
}

const paper = document.createElement("canvas");

function drawRaster(context: CanvasRenderingContext2D, panel: Panel, raster: Raster, low: number, high: number): void {
  paper.width = raster.columns;
  paper.height = raster.rows;
  paper.getContext("2d")!.putImageData(paint(raster.phi, raster.columns, raster.rows, low, high), 0, 0);
  const box = panel.inner;
  context.imageSmoothingEnabled = false;
  context.drawImage(paper, box.left, box.top, box.width, box.height);
}

/** Fronts as lines: thin for the many of a fan, thick for shocks. White on black, to be seen on any colour. */
function drawFronts(context: CanvasRenderingContext2D, panel: Panel, picture: Picture): void {
  const shocks = shocksOf(picture);
  const isShock = new Set(shocks);
  const fans = picture.fronts.filter((f) => !isShock.has(f));
  const draw = (fronts: Picture["fronts"], colour: string, width: number): void => {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    for (const f of fronts) {
      context.moveTo(panel.x(f.tBegin), panel.y(f.zBegin));
      context.lineTo(panel.x(f.tEnd), panel.y(f.zEnd));
    }
    context.stroke();
  };
  context.lineCap = "round";
  draw(fans, "rgba(255,255,255,0.35)", 0.7);
  draw(shocks, "#000", 3.4);
  draw(shocks, "#fff", 1.6);
}

function drawData(context: CanvasRenderingContext2D, panel: Panel, marks: PlaneMarks, low: number, high: number): void {
  const isPhi = marks.data.quantity === "point" || marks.data.quantity === "bin";
  for (const row of marks.data.rows) {
    context.beginPath();
    context.arc(panel.x(row.t), panel.y(row.z), 2.6, 0, 2 * Math.PI);
    context.fillStyle = isPhi ? css((row.value - low) / (high - low)) : "#fff";
    context.fill();
    context.strokeStyle = "rgba(0,0,0,0.75)";
    context.lineWidth = 0.8;
    context.stroke();
  }
}

export function drawPlane(panel: Panel, picture: Picture, raster: Raster, marks: PlaneMarks): void {
  const { facts } = picture;
  panel.x.domain([0, picture.tMax]);
  panel.y.domain([facts.bottom, facts.top]);
  const context = panel.context();
  drawRaster(context, panel, raster, facts.lowest, facts.highest);
  const box = panel.inner;
  context.save();
  context.beginPath();
  context.rect(box.left, box.top, box.width, box.height);
  context.clip();
  if (marks.showFronts) drawFronts(context, panel, picture);
  drawData(context, panel, marks, facts.lowest, facts.highest);
  context.restore();
  panel.drawAxes(marks.labels.x, marks.labels.y);
  drawMarks(panel, picture, marks);
}

function drawMarks(panel: Panel, picture: Picture, marks: PlaneMarks): void {
  const { facts } = picture;
  const [top, bottom] = [panel.y(facts.top), panel.y(facts.bottom)];
  const interfaces = facts.isLayered ? facts.knots : [];
  const seen = marks.times.filter((m) => Number.isFinite(m.t) && m.t <= picture.tMax);
  const taken: Box[] = [];
  join(panel.below, [
    ...interfaces.map((z) => ({ key: `interface ${z}`, z })),
  ], (i) => i.key, () => svg("line", { class: "interface" }), (line, i) => {
    const y = panel.y(i.z);
    set(line, { x1: panel.frame.left, x2: panel.frame.width - panel.frame.right, y1: y, y2: y });
  });
  join(panel.marks, [
    { key: "now", m: undefined },
    ...seen.map((m) => ({ key: m.id, m })),
    ...(marks.collision ? [{ key: "collision", m: undefined }] : []),
  ], (i) => i.key, () => svg("g"), (g, i) => {
    g.replaceChildren();
    if (i.key === "now") {
      const x = panel.x(marks.t);
      g.append(svg("line", { class: "now halo", x1: x, x2: x, y1: top, y2: bottom }), svg("line", { class: "now", x1: x, x2: x, y1: top, y2: bottom }));
    } else if (i.key === "collision" && marks.collision) {
      g.append(svg("circle", { class: "collision", cx: panel.x(marks.collision.t), cy: panel.y(marks.collision.z), r: 9 }));
    } else if (i.m) {
      const [x, y] = eventPlace(panel, picture, i.m);
      set(g, { class: "event", "data-event-mark": i.m.id });
      if (i.m.z === undefined) g.append(svg("line", { x1: x, x2: x, y1: top, y2: bottom, class: "steady" }));
      else g.append(svg("circle", { cx: x, cy: y, r: 4.5 }));
      const place = labelPlace(panel, i.m, x, y, taken);
      if (!place) return;
      const text = svg("text", { x: place.x, y: place.y, "text-anchor": "start", class: place.y < top ? "outside" : "inside" });
      const low = i.m.id.replace(/^t\^?_?/, "");
      text.append(svg("tspan", {}, i.m.id.startsWith("t^") ? "t\u0302" : "t"), svg("tspan", { dy: low === "*" ? -3 : 3, "font-size": "80%" }, low));
      g.append(text);
    }
  });
}

interface Box {
  x: number;
  y: number; // of the baseline
  width: number;
}
const LINE = 15;

/** Where an event stands in the plane, in pixels; the steady state at its upper end. */
export const eventPlace = (panel: Panel, picture: Picture, m: NamedTime): [number, number] => [panel.x(m.t), panel.y(m.z ?? picture.facts.top)];

/** Beside the mark where no other name is; none where all places are taken. */
function labelPlace(panel: Panel, m: NamedTime, x: number, y: number, taken: Box[]): Box | undefined {
  const width = 9 + 6.5 * m.id.replace(/^t\^?_?/, "").length;
  const isTop = y <= panel.frame.top + 1;
  const around: [number, number][] = isTop ? [[-width / 2, -9], [6, -9], [-width - 6, -9]] : [[5, -7], [5, 16], [-width - 5, -7], [-width - 5, 16]];
  const box = panel.inner;
  const place = around.map(([dx, dy]) => ({ x: x + dx, y: y + dy, width })).find((b) =>
    b.x >= box.left - 8 && b.x + width <= box.left + box.width + 12 && b.y <= box.top + box.height &&
    taken.every((other) => b.x + width < other.x || other.x + other.width < b.x || Math.abs(b.y - other.y) > LINE));
  if (place) taken.push(place);
  return place;
}

/** The plane in words. */
export function planeInWords(picture: Picture, times: NamedTime[], name: string, meaning: string): string {
  const { facts } = picture;
  const events = times.map((m) => `${m.id}, ${m.meaning}: ${brief(m.t)}`).join("; ");
  const isSegregated = meaning.includes("grains") && picture.events && Number.isFinite(picture.events.tStar);
  const end = isSegregated ? ` In the end all small grains lie below z = ${brief(picture.events!.steadyHeight)}.` : "";
  return `${name}. phi${meaning && ", " + meaning}, over time 0 to ${brief(picture.tMax)} and height ${brief(facts.bottom)} to ${brief(facts.top)}. ` +
    (events ? `Event times: ${events}.${end}` : picture.noEvents);
}
