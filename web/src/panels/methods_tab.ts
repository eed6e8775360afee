// SPDX-License-Identifier: BSD-3-Clause
// Methods side by side at the time shown: their profiles, their distance to the exact solution, their time.
import formulas from "virtual:formulas";
import type { App } from "../app.ts";
import { spread } from "../bed/picture.ts";
import { CELLS, fineEnough } from "../bed/costs.ts";
import type { Pieces } from "../engine/engine.ts";
import { Chart, type Series } from "../view/chart.ts";
import { brief, milliseconds } from "../view/numbers.ts";
import { html } from "../view/svg.ts";
import { logSlider } from "./slider.ts";

interface Measured {
  l1: number;
  ms: number;
  pieces: Pieces;
}

const RESOLUTIONS = [0.2, 0.1, 0.05, 0.02, 0.01, 0.005];
const IDLE_MS = 250;

function stairs(pieces: Float64Array): [number, number][] {
  const points: [number, number][] = [];
  for (let i = 0; i < pieces.length; i += 4) points.push([pieces[i + 2]!, pieces[i]!], [pieces[i + 3]!, pieces[i + 1]!]);
  return points;
}

/** Milliseconds of a run: the best of some batches, each long for a clock that browsers keep coarse; others use this machine as well. */
function quickest(run: () => void): number {
  let best = Infinity;
  let batches = 0;
  for (let n = 1, begin = performance.now(), end = begin + 120; batches < 5 && (best === Infinity || begin < end); ) {
    for (let i = 0; i < n; ++i) run();
    const now = performance.now();
    if (now - begin < 1.5) n *= 2;
    else [best, batches] = [Math.min(best, (now - begin) / n), batches + 1];
    begin = now;
  }
  return best;
}

class Card {
  readonly chart = new Chart();
  readonly error = html("strong");
  readonly time = html("span");
  readonly element: HTMLElement;
  constructor(readonly id: string, title: string, control: HTMLElement | string) {
    const formula = html("span", { class: "formula" });
    formula.innerHTML = formulas["l1"]!;
    this.error.id = `error-${id}`;
    this.time.id = `time-${id}`;
    this.element = html("section", { class: "card", "aria-label": title }, html("h3", {}, title), control, this.chart.element,
      html("p", {}, formula, " = ", this.error), html("p", {}, "computed in ", this.time));
  }
}

export class MethodsTab {
  readonly element: HTMLElement;
  private readonly trail = new Map<string, [number, number][]>();
  private readonly course = new Chart();
  private readonly resolution = logSlider("resolution", "largest step of φ in a fan", 0.002, 0.5, 0.1, (x) => Number(x.toPrecision(2)), () => this.measure("tracked"));
  private readonly cells = logSlider("cells", "cells", 10, 2000, 100, Math.round, () => this.measure("grid"));
  private readonly scheme = html("select", { id: "scheme" }, ...["engquist-osher", "godunov", "muscl"].map((s) => html("option", {}, s)));
  private readonly cards: { exact: Card; tracked: Card; grid: Card };
  private readonly note = html("p", { class: "note" });
  private readonly lesson = html("p", { id: "lesson" });
  private idle = 0;
  private exact: [number, number][] = [];
  private exactMs = 0;
  private now: { tracked?: Measured | undefined; grid?: Measured | undefined } = {};

  constructor(private readonly app: App, private readonly isShown: () => boolean) {
    this.scheme.addEventListener("change", () => {
      this.trail.delete("grid");
      this.fill();
    });
    this.cards = {
      exact: new Card("exact", "Exact", html("p", { class: "note" }, "The Lax-Hopf formula: no grid, no time step, each point by itself.")),
      tracked: new Card("tracked", "Front tracking", this.resolution.element),
      grid: new Card("grid", "Finite volumes", html("div", {}, html("label", { class: "field" }, "scheme", this.scheme), this.cells.element)),
    };
    this.element = html("div", {},
      html("p", { class: "lead" }, "The profile at the time shown, by three roads that share nothing but the bed; grey is the exact one. Slide the resolutions: what does an error half as large cost each of them?"), this.note,
      html("div", { class: "cards" }, this.cards.exact.element, this.cards.tracked.element, this.cards.grid.element,
        html("section", { class: "card", "aria-label": "Speed against error" }, html("h3", {}, "Speed against error"), this.course.element,
          html("p", { class: "note" }, html("span", { class: "key tracked" }, "●"), " front tracking  ", html("span", { class: "key grid" }, "■"), " finite volumes; large: as slid"), this.lesson)));
    app.listen({ sceneChanged: () => this.later(), timeChanged: () => this.later() });
  }

  /** Soon, when the hand rests. */
  later(): void {
    this.trail.clear();
    window.clearTimeout(this.idle);
    if (this.isShown()) this.idle = window.setTimeout(() => this.fill(), IDLE_MS);
  }

  private methodOf(which: "tracked" | "grid", fineness: number): string {
    return which === "tracked" ? `front-tracking resolution=${fineness} max-collisions=400000` : `${this.scheme.value} cells=${fineness}`;
  }

  private run(method: string): Measured | undefined {
    try {
      const once = (): void => void this.app.engine.pieces(method, this.app.t, false);
      const pieces = this.app.engine.pieces(method, this.app.t, true);
      return { l1: pieces.l1, ms: quickest(once), pieces };
    } catch {
      return undefined;
    }
  }

  fill(): void {
    const { engine, picture, t } = this.app;
    const refusal = engine.refusal("exact");
    this.note.textContent = refusal ? `No exact solution to compare with: ${refusal}` : "";
    this.note.hidden = !refusal;
    const z = spread(picture.facts.bottom, picture.facts.top, 401);
    const begin = performance.now();
    const { phi } = engine.solve(picture.method, [t], z);
    this.exactMs = performance.now() - begin;
    this.exact = z.map((height, i) => [phi[i]!, height]);
    this.cards.exact.error.textContent = refusal ? "unknown" : "0";
    this.cards.exact.time.textContent = `${milliseconds(this.exactMs)} for 401 points`;
    this.drawProfile(this.cards.exact, []);
    this.measure("tracked");
    this.measure("grid");
    this.element.dataset["t"] = String(t);
    void this.fillTrails();
  }

  private measure(which: "tracked" | "grid"): void {
    const fineness = which === "tracked" ? this.resolution.value : this.cells.value;
    const measured = this.run(this.methodOf(which, fineness));
    this.now[which] = measured;
    const card = this.cards[which];
    card.error.textContent = !measured ? "not for this bed" : Number.isNaN(measured.l1) ? "unknown" : measured.l1.toExponential(2);
    card.time.textContent = measured ? milliseconds(measured.ms) : "";
    this.drawProfile(card, measured ? stairs(measured.pieces.pieces) : []);
    this.drawCourse();
  }

  private async fillTrails(): Promise<void> {
    const { picture, t } = this.app;
    for (const which of ["tracked", "grid"] as const) {
      if (this.trail.has(which)) continue;
      const points: [number, number][] = [];
      this.trail.set(which, points);
      for (const fineness of which === "tracked" ? RESOLUTIONS : CELLS) {
        await new Promise((done) => setTimeout(done));
        if (picture !== this.app.picture || t !== this.app.t || !this.isShown()) return;
        const measured = this.run(this.methodOf(which, fineness));
        if (!measured || !(measured.l1 > 0)) break;
        points.push([measured.ms, measured.l1]);
        for (const point of points) point[0] = Math.min(point[0], measured.ms); // what is coarser takes no longer
        this.drawCourse();
        if (measured.ms > 150) break;
      }
    }
  }

  /** What the curves say of the resolution that is slid. */
  private say(): void {
    const { tracked, grid } = this.now;
    const trail = this.trail.get("grid") ?? [];
    if (!tracked || !grid || !(tracked.l1 > 0) || !(grid.l1 > 0) || trail.length < 2) {
      this.lesson.textContent = "";
      return;
    }
    const { cells, ms } = fineEnough(trail, tracked.l1);
    const most = 8 * CELLS.at(-1)!;
    const needs = cells > most ? `more than ${most} cells` : `about ${Number(cells.toPrecision(1))} cells and ${milliseconds(ms)}, ${brief(Number((ms / tracked.ms).toPrecision(1)))} times as long`;
    this.lesson.textContent = `For the error of front tracking as slid, ${tracked.l1.toExponential(1)} in ${milliseconds(tracked.ms)}, ${this.scheme.value} needs ${needs}${cells > CELLS.at(-1)! ? " if it goes on so" : ""}.`;
  }

  private drawProfile(card: Card, points: [number, number][]): void {
    const { facts } = this.app.picture;
    card.chart.draw({
      width: 240, height: 220, left: 40, xTitle: "φ", yTitle: "z", x: [facts.lowest, facts.highest], y: [facts.bottom, facts.top],
      label: `${card.id}: phi over z at t = ${this.app.t.toPrecision(4)}`,
    }, [{ key: "exact", class: "curve exact", points: this.exact }, { key: "own", class: `curve ${card.id}`, points }]);
  }

  private drawCourse(): void {
    this.say();
    const series: Series[] = [];
    const all: [number, number][] = [];
    for (const which of ["tracked", "grid"] as const) {
      const trail = this.trail.get(which) ?? [];
      const now = this.now[which];
      const point: [number, number][] = now && now.l1 > 0 ? [[now.ms, now.l1]] : [];
      all.push(...trail, ...point);
      series.push({ key: which, class: `curve ${which}`, points: trail, dots: 2.5 }, { key: `${which} now`, class: `curve ${which}`, points: point, dots: 6, line: false });
    }
    const ms = all.map((p) => p[0]);
    const errors = all.map((p) => p[1]);
    const range = (xs: number[], otherwise: [number, number]): [number, number] => (xs.length > 0 ? [Math.min(...xs) / 1.6, Math.max(...xs) * 1.6] : otherwise);
    this.course.draw({
      width: 300, height: 220, left: 58, xTitle: "time [ms]", yTitle: "L1 error", x: range(ms, [0.1, 10]), y: range(errors, [1e-4, 1e-1]), logX: true, logY: true,
      label: "L1 error against computing time of front tracking and of finite volumes",
    }, series);
  }
}
