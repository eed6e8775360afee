// SPDX-License-Identifier: BSD-3-Clause
// Collisions one by one, each with its Riemann problem in the flux plane.
import formulas from "virtual:formulas";
import type { App } from "../app.ts";
import { type Chord, fluxAt, type RiemannProblem, riemannProblem } from "../bed/riemann.ts";
import type { Collision } from "../engine/engine.ts";
import { Chart, type Series } from "../view/chart.ts";
import { brief } from "../view/numbers.ts";
import { html } from "../view/svg.ts";
import { logSlider } from "./slider.ts";

const MOST = 6;

/** Fronts as rows of a table: what they carry, and how fast. */
function rowsOf(title: string, chords: readonly Chord[]): HTMLElement[] {
  const rows = chords.slice(0, MOST).map((c) => [title, brief(c.below), brief(c.above), brief(c.speed)]);
  if (chords.length > MOST) rows.push([title, `and ${chords.length - MOST} more`, "", ""]);
  return rows.map(([first, ...rest]) => html("tr", {}, html("th", { scope: "row" }, first!), ...rest.map((x) => html("td", { class: "number" }, x))));
}

export class CollisionsTab {
  readonly element: HTMLElement;
  private index = 0;
  private readonly chart = new Chart();
  private readonly count = html("output", { id: "collision-count", "aria-live": "polite" });
  private readonly words = html("p", { id: "collision-words" });
  private readonly rows = html("tbody");
  private readonly table = html("table", { id: "collision-fronts" }, html("thead", {}, html("tr", {}, ...["front", "φ below", "φ above", "speed"].map((h) => html("th", { scope: "col" }, h)))), this.rows);
  private readonly sides = html("p", { class: "note" }, html("span", { class: "key below" }, "– · –"), " flux below the interface  ", html("span", { class: "key above" }, "——"), " above it");
  private readonly range = html("input", { type: "range", id: "collision-index", min: 0, max: 0, step: 1, "aria-label": "collision" });
  private readonly fan = logSlider("fan-step", "step of φ in the fans", 0.01, 0.5, 0.2, (x) => Number(x.toPrecision(2)), (x) => {
    this.app.frontResolution = x;
    this.app.refreshFronts();
    this.app.draw();
    this.index = 0;
    this.show();
  });

  constructor(private readonly app: App, private readonly isShown: () => boolean) {
    const step = (by: number, id: string, text: string, label: string): HTMLElement => {
      const button = html("button", { type: "button", id, "aria-label": label }, text);
      button.addEventListener("click", () => this.go(this.index + by));
      return button;
    };
    this.range.addEventListener("input", () => this.go(this.range.valueAsNumber));
    const rule = html("span", { class: "formula" });
    rule.innerHTML = formulas["hugoniot"]!;
    this.element = html("div", {},
      html("p", { class: "lead" }, "Front tracking knows the solution between collisions: fronts run straight. Step from one to the next, and see the Riemann problem that each is. Steps of φ stand for a fan: the finer, the more fronts, and the nearer to the event times. A front is a chord of the flux; its slope is its speed, ", rule, "."),
      html("div", { class: "row steps" }, step(-1, "collision-before", "◀", "collision before"), this.range, step(1, "collision-next", "▶", "next collision"), this.count),
      this.fan.element, html("div", { class: "cards" }, html("section", { class: "card wide" }, this.chart.element), html("section", { class: "card" }, this.words, this.table,
        html("p", { class: "note" }, html("span", { class: "key incoming" }, "- - -"), " chord of a front that comes in  ", html("span", { class: "key outgoing" }, "——"), " that goes out"), this.sides)));
    app.listen({ sceneChanged: (isDrag) => { if (!isDrag && this.isShown()) this.show(); } });
  }

  private get all(): Collision[] {
    return this.app.picture.collisions;
  }

  /** Shown or hidden: while shown the fans are as coarse as the slider says. */
  enter(): void {
    this.app.frontResolution = this.fan.value;
    this.app.refreshFronts();
    this.show();
  }
  leave(): void {
    this.app.frontResolution = 0.04;
    this.app.collision = undefined;
    this.app.refreshFronts();
    this.app.draw();
  }

  private go(index: number): void {
    this.index = Math.min(this.all.length - 1, Math.max(0, index));
    this.show();
  }

  show(): void {
    const { app } = this;
    this.index = Math.min(this.index, Math.max(0, this.all.length - 1));
    this.range.max = String(Math.max(0, this.all.length - 1));
    this.range.value = String(this.index);
    const collision = this.all[this.index];
    if (!collision) {
      this.count.textContent = "no collisions";
      this.words.textContent = app.engine.refusal("front-tracking") || "Nothing meets in the time shown.";
      this.table.hidden = this.sides.hidden = true;
      this.chart.element.setAttribute("hidden", "");
      app.collision = undefined;
      app.draw();
      return;
    }
    this.count.textContent = `${this.index + 1} of ${this.all.length}`;
    app.collision = collision;
    app.draw();
    app.setTime(collision.t);
    const problem = riemannProblem(app.engine, app.picture.facts, app.picture.fronts, collision);
    const where = problem.isWall ? "at a wall" : problem.isInterface ? "at an interface" : "inside a layer";
    this.words.textContent = `t = ${brief(collision.t)}, z = ${brief(collision.z)}, ${where}: ${collision.incoming} in, ${collision.outgoing} out.`;
    this.rows.replaceChildren(...rowsOf("comes in", problem.incoming), ...rowsOf("goes out", problem.outgoing));
    this.table.hidden = false;
    this.sides.hidden = !problem.isInterface;
    this.chart.element.removeAttribute("hidden");
    this.draw(problem);
  }

  private draw(problem: RiemannProblem): void {
    const { facts } = this.app.picture;
    const curves: Series[] = [{ key: "above", class: "curve flux-above", points: problem.above.map((p) => [p.phi, p.flux] as const) }];
    if (problem.isInterface) curves.unshift({ key: "below", class: "curve flux-below", points: problem.below.map((p) => [p.phi, p.flux] as const) });
    const chord = (c: Chord, i: number, kind: string): Series => {
      const curve = problem.isInterface && c.side === "below" ? problem.below : problem.above;
      return { key: `${kind} ${i}`, class: `chord ${kind}`, dots: 3, points: [[c.below, fluxAt(curve, c.below)], [c.above, fluxAt(curve, c.above)]] };
    };
    const series = [...curves, ...problem.incoming.map((c, i) => chord(c, i, "incoming")), ...problem.outgoing.map((c, i) => chord(c, i, "outgoing"))];
    const fluxes = [...problem.below, ...problem.above].map((p) => p.flux);
    const [low, high] = [Math.min(...fluxes, 0), Math.max(...fluxes, 0)];
    const margin = 0.08 * (high - low || 1);
    this.chart.draw({
      width: 440, height: 300, xTitle: "φ", yTitle: "flux s a f(φ)", x: [facts.lowest, facts.highest], y: [low - margin, high + margin],
      label: "Flux plane of the collision: " + this.words.textContent,
    }, series);
  }
}
