// SPDX-License-Identifier: BSD-3-Clause
// From measurements to the bed: residuals, the search under way, intervals, warnings.
import datasets from "virtual:datasets";
import type { App } from "../app.ts";
import { textOf } from "../bed/files.ts";
import { expanded, fieldsOf, withValues } from "../bed/entries.ts";
import { readScene, type Scene, type Table, writeScene } from "../bed/scene.ts";
import type { Estimate } from "../engine/engine.ts";
import type { FitNews, FitTask } from "../engine/fit_messages.ts";
import FitWorker from "../engine/fit_worker.ts?worker&inline";
import { Chart } from "../view/chart.ts";
import { drawEllipse } from "../view/ellipse.ts";
import { brief } from "../view/numbers.ts";
import { html } from "../view/svg.ts";

interface DataSet {
  name: string;
  scene: string;
  fit: string;
  observations: string;
}

export const DATASETS: readonly DataSet[] = [
  { name: "five layers, means over bins (made up, noise 0.01)", scene: "paper-example-4/scene.toml", fit: "paper-example-4/fit-bin-noise-0.01.toml", observations: "paper-example-4/observations-bin-noise-0.01.csv" },
  { name: "exponential a(z), means over bins (made up, noise 0.01)", scene: "paper-example-5/scene.toml", fit: "paper-example-5/fit-bin-noise-0.01.toml", observations: "paper-example-5/observations-bin-noise-0.01.csv" },
  { name: "particle simulation, t < 200, five layers", scene: "dem-shear-cell-piecewise/scene-5-layers.toml", fit: "dem-shear-cell-piecewise/fit-early-5-layers.toml", observations: "dem-shear-cell-piecewise/observations-early.csv" },
  { name: "cubic flux: rates and γ (made up, noise 0.01)", scene: "segregation-gamma-0.9/scene.toml", fit: "segregation-gamma-0.9/fit.toml", observations: "segregation-gamma-0.9/observations.csv" },
  { name: "settling column: speed and exponent (made up)", scene: "settling-column/scene.toml", fit: "settling-column/fit.toml", observations: "settling-column/observations.csv" },
];

export class FitTab {
  readonly element: HTMLElement;
  private csv = "";
  private fit: Table = {};
  private worker: Worker | undefined;
  private estimate: Estimate | undefined;
  private course: [number, number][] = [];
  private waiting: (() => void) | undefined;
  private readonly charts = { residuals: new Chart(), course: new Chart(), ellipse: new Chart() };
  private readonly choose = html("select", { id: "dataset" }, html("option", { value: "" }, "choose ..."), ...DATASETS.map((d, i) => html("option", { value: i }, d.name)));
  private readonly file = html("input", { type: "file", id: "data-file", accept: ".csv,.txt,.tsv,.stat,text/*" });
  private readonly about = html("p", { class: "note", id: "data-about", "aria-live": "polite" });
  private readonly unknowns = html("div", { id: "unknowns" });
  private readonly run = html("button", { type: "button", id: "run-fit", class: "main", disabled: true }, "fit");
  private readonly stop = html("button", { type: "button", id: "stop-fit", hidden: true }, "stop");
  private readonly state = html("p", { id: "fit-state", role: "status" });
  private readonly result = html("table", { id: "estimates", hidden: true });
  private readonly warnings = html("ul", { id: "warnings" });
  private readonly pair = { a: html("select", { id: "ellipse-a", "aria-label": "first parameter" }), b: html("select", { id: "ellipse-b", "aria-label": "second parameter" }) };
  private readonly ellipseBox = html("section", { class: "card", hidden: true }, html("h3", {}, "What is known together"), html("div", { class: "row" }, this.pair.a, this.pair.b), this.charts.ellipse.element,
    html("p", { class: "note" }, "95 % of both together inside the ellipse; the lines are the intervals of each alone."));

  constructor(private readonly app: App, private readonly opened: () => void) {
    const drop = html("div", { class: "drop", id: "drop" }, "Drop a CSV with columns t, z, phi (or M; width, sigma) here, or ", html("label", {}, "open one ", this.file), ".");
    this.element = html("div", {},
      html("p", { class: "lead" }, "Measured φ, and which a(z) explains it. Drag the rates until the residuals look like noise, or let the search do it: it starts from the bed on the screen."),
      html("div", { class: "row" }, html("label", { class: "field wide" }, "data shipped with the page", this.choose)), drop, this.about,
      this.unknowns, html("div", { class: "row" }, this.run, this.stop), this.state,
      html("div", { class: "cards" },
        html("section", { class: "card full" }, html("h3", {}, "Estimates"), this.result, this.warnings),
        html("section", { class: "card" }, html("h3", {}, "Residuals"), this.charts.residuals.element),
        html("section", { class: "card" }, html("h3", {}, "The search"), this.charts.course.element), this.ellipseBox));
    this.choose.addEventListener("change", () => {
      const data = DATASETS[Number(this.choose.value)];
      if (this.choose.value === "" || !data) return;
      this.openDataSet(data);
      this.opened();
    });
    this.file.addEventListener("change", () => {
      const file = this.file.files?.[0];
      if (file) void textOf(file).then((text) => this.openCsv(text, file.name));
    });
    this.run.addEventListener("click", () => this.begin());
    this.stop.addEventListener("click", () => this.end("stopped; the bed on the screen is the last point of the search"));
    for (const select of [this.pair.a, this.pair.b]) select.addEventListener("change", () => this.showEllipse());
    app.listen({ sceneChanged: (isDrag) => this.sceneChanged(isDrag) });
    this.showResiduals();
    this.showCourse();
  }

  openDataSet(data: DataSet): void {
    const fit = readScene(datasets[data.fit]!);
    let scene = readScene(datasets[data.scene]!);
    const unknown = fit["unknown"] as Table;
    const start = unknown["start"];
    if (Array.isArray(start)) scene = withValues(scene, unknown["parameters"] as string[], start.map(Number));
    const { start: _, ...rest } = unknown;
    this.fit = { ...fit, unknown: rest };
    this.app.open(scene);
    this.openCsv(datasets[data.observations]!, data.name);
  }

  openCsv(csv: string, name: string): void {
    this.end("");
    try {
      this.app.data = this.app.engine.setObservations(csv);
    } catch (error) {
      this.about.textContent = (error as Error).message;
      return;
    }
    this.csv = csv;
    this.estimate = undefined;
    if (!this.fit["unknown"]) this.fit = { unknown: this.usualUnknowns };
    const { data } = this.app;
    this.about.textContent = [`${name}: ${data.rows.length} observations (${data.quantity})`, data.understood, ...data.notes].filter(Boolean).join(". ");
    this.showUnknowns();
    this.showResult();
    const last = Math.max(...data.rows.map((r) => r.t));
    this.app.setTimeShown(Number((last * 1.05).toPrecision(2)));
    this.showResiduals();
  }

  /** What the engine is asked: a fit file without the files it names, which the engine has. */
  private get task(): string {
    const { scene: _, observations: __, ...rest } = this.fit;
    return writeScene(rest);
  }
  private get usualUnknowns(): Table {
    const names = ["shear_rate.values", "shear_rate.amplitude", "shear_rate.decay"];
    return { parameters: names.filter((n) => fieldsOf(this.app.scene).includes(n)) };
  }
  /** The fit file of the program. */
  get fitToml(): string {
    return writeScene({ name: String(this.app.scene["name"] ?? "fit"), unknown: this.usualUnknowns, ...this.fit, scene: "scene.toml", observations: "observations.csv" });
  }
  get observationsCsv(): string {
    return this.csv;
  }

  private get chosen(): string[] {
    return ((this.fit["unknown"] as Table | undefined)?.["parameters"] as string[] | undefined) ?? [];
  }

  private sceneChanged(isDrag: boolean): void {
    if (this.csv && !this.worker) this.showResiduals();
    if (!isDrag) this.showUnknowns();
  }

  private showUnknowns(): void {
    const fields = this.csv ? fieldsOf(this.app.scene) : [];
    const key = fields.join() + this.chosen.join();
    if (this.unknowns.dataset["of"] === key) return;
    this.unknowns.dataset["of"] = key;
    this.unknowns.replaceChildren(...(fields.length > 0 ? [html("span", {}, "unknown: ")] : []), ...fields.map((name) => {
      const box = html("input", { type: "checkbox", value: name, ...(this.chosen.includes(name) ? { checked: true } : {}) });
      box.addEventListener("change", () => {
        const parameters = box.checked ? [...this.chosen, name] : this.chosen.filter((n) => n !== name);
        this.fit = { ...this.fit, unknown: { parameters } }; // bounds and shape belong to those of before
        this.showUnknowns();
        this.showResiduals();
      });
      return html("label", { class: "check" }, box, name);
    }));
    this.run.disabled = this.csv === "" || this.chosen.length === 0;
  }

  private begin(): void {
    this.end("");
    this.course = [];
    this.estimate = undefined;
    this.showResult();
    const { app } = this;
    const scene = app.scene;
    const names = this.chosen;
    this.worker = new FitWorker();
    this.stop.hidden = false;
    this.run.disabled = true;
    this.state.textContent = "searching ...";
    this.worker.onmessage = ({ data }: MessageEvent<FitNews>) => this.hear(data, scene, names);
    this.worker.onerror = (event) => this.end(`the worker stopped: ${event.message}`);
    const task: FitTask = { module: app.module, scene: app.toml, observations: this.csv, fit: this.task };
    this.worker.postMessage(task);
    app.history.push(scene);
  }

  private hear(news: FitNews, scene: Scene, names: string[]): void {
    if (news.kind === "refused") return this.end(news.why);
    if (news.kind === "step") {
      this.course.push([news.evaluations, Math.max(news.misfit, 1e-12)]);
      this.state.textContent = `evaluation ${news.evaluations}, misfit ${brief(news.misfit)}: ${expanded(scene, names).map((n, i) => `${n} = ${brief(news.values[i]!)}`).join(", ")}`;
      this.follow(() => {
        this.app.history.replace(withValues(scene, names, news.values));
        this.app.update(true);
        this.showCourse();
      });
      return;
    }
    const { estimate } = news;
    this.estimate = estimate;
    if (estimate.parameters.length > 0) this.app.history.replace(withValues(scene, names, estimate.parameters.map((p) => p.estimate)));
    this.end(`${estimate.status}: ${estimate.message}. ${estimate.evaluations} evaluations in ${news.seconds.toFixed(2)} s, misfit ${brief(estimate.misfit)} (${estimate.quantity}, ${estimate.loss})`);
    this.element.dataset["status"] = estimate.status;
    this.app.update(false);
    this.showResult();
    this.showResiduals();
  }

  /** Draws the last step only, if several come between two pictures. */
  private follow(draw: () => void): void {
    const isWaiting = this.waiting !== undefined;
    this.waiting = draw;
    if (isWaiting) return;
    requestAnimationFrame(() => {
      this.waiting?.();
      this.waiting = undefined;
    });
  }

  private end(state: string): void {
    this.waiting = undefined;
    this.worker?.terminate();
    this.worker = undefined;
    this.stop.hidden = true;
    this.run.disabled = this.csv === "" || this.chosen.length === 0;
    this.state.textContent = state;
    delete this.element.dataset["status"];
  }

  private showResult(): void {
    const { estimate } = this;
    this.result.hidden = !estimate;
    this.ellipseBox.hidden = !estimate || estimate.parameters.length < 2;
    this.warnings.replaceChildren(...(estimate?.warnings ?? []).map((w) => html("li", {}, w)));
    if (!estimate) return;
    const interval = (p: Estimate["parameters"][number]): string =>
      Number.isFinite(p.low) ? `${brief(p.low)} to ${brief(p.high)}` : Number.isFinite(p.profileLow) || Number.isFinite(p.profileHigh) ? `${brief(p.profileLow)} to ${brief(p.profileHigh)} (profile)` : p.atBound ? "at a bound" : "none";
    this.result.replaceChildren(
      html("thead", {}, html("tr", {}, ...["parameter", "start", "estimate", "std error", "95 % interval"].map((h) => html("th", { scope: "col" }, h)))),
      html("tbody", {}, ...estimate.parameters.map((p) => html("tr", {}, html("th", { scope: "row" }, p.name),
        ...[brief(p.start), brief(p.estimate), Number.isFinite(p.error) ? brief(p.error) : "none", interval(p)].map((x) => html("td", { class: "number" }, x))))));
    const names = estimate.parameters.map((p) => p.name);
    this.pair.a.replaceChildren(...names.map((n, i) => html("option", { value: i }, n)));
    this.pair.b.replaceChildren(...names.map((n, i) => html("option", { value: i, ...(i === 1 ? { selected: true } : {}) }, n)));
    this.showEllipse();
  }

  private showEllipse(): void {
    if (this.estimate && this.estimate.parameters.length > 1) drawEllipse(this.charts.ellipse, this.estimate, Number(this.pair.a.value), Number(this.pair.b.value));
  }

  /** What the bed on the screen says, less what was measured. */
  private showResiduals(): void {
    const { rows } = this.app.data;
    let points: [number, number][] = [];
    if (this.csv && this.chosen.length > 0) {
      try {
        const predicted = this.app.engine.predict(this.task);
        points = rows.map((row, i) => [row.z, predicted[i]! - row.value]);
      } catch (error) {
        this.state.textContent = (error as Error).message;
      }
    }
    const size = Math.max(1e-9, ...points.map((p) => Math.abs(p[1])));
    const rms = Math.sqrt(points.reduce((sum, p) => sum + p[1] ** 2, 0) / Math.max(1, points.length));
    const { facts } = this.app.picture;
    this.charts.residuals.draw({
      width: 320, height: 220, xTitle: "z", yTitle: points.length > 0 ? `bed less data, rms ${brief(rms)}` : "bed less data", x: [facts.bottom, facts.top], y: [-1.1 * size, 1.1 * size],
      label: points.length > 0 ? `Residuals over height, root mean square ${brief(rms)}` : "No data yet",
    }, [{ key: "zero", class: "curve zero", points: [[facts.bottom, 0], [facts.top, 0]] }, { key: "all", class: "curve residual", points, line: false, dots: 1.8 }]);
    this.element.dataset["rms"] = String(rms);
  }

  private showCourse(): void {
    const xs = this.course.map((p) => p[0]);
    const ys = this.course.map((p) => p[1]);
    this.charts.course.draw({
      width: 320, height: 220, left: 58, xTitle: "evaluations", yTitle: "misfit", x: [0, Math.max(10, ...xs)],
      y: ys.length > 0 ? [Math.min(...ys) / 1.5, Math.max(...ys) * 1.5] : [1, 100], logY: true, label: "Misfit over the evaluations of the search",
    }, [{ key: "course", class: "curve tracked", points: this.course, dots: 3 }]);
  }
}
