// SPDX-License-Identifier: BSD-3-Clause
// From measurements to the bed: residuals, the search under way, intervals, warnings.
import datasets from "virtual:datasets";
import type { App } from "../app.ts";
import { textOf } from "../bed/files.ts";
import { expanded, fieldsOf, unknownOf, withValues } from "../bed/entries.ts";
import { readScene, type Scene, type Table, writeScene } from "../bed/scene.ts";
import type { Estimate } from "../engine/engine.ts";
import type { FitNews, FitTask } from "../engine/fit_messages.ts";
import FitWorker from "../engine/fit_worker.ts?worker&inline";
import { parameterInWords } from "../bed/words.ts";
import { Chart } from "../view/chart.ts";
import { drawCourse, drawResiduals } from "../view/fit_charts.ts";
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

/** Half the interval, of the estimate. */
function percent(p: Estimate["parameters"][number]): string {
  const half = (100 * (p.high - p.low)) / 2 / Math.abs(p.estimate);
  return Number.isFinite(half) ? `± ${Number(half.toPrecision(2))} %` : "";
}

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
  private readonly sure = html("p", { id: "how-sure" });
  private readonly residualsBox = html("section", { class: "card", hidden: true }, html("h3", {}, "Residuals"), this.charts.residuals.element);
  private readonly courseBox = html("section", { class: "card", hidden: true }, html("h3", {}, "The search"), this.charts.course.element,
    html("p", { class: "note" }, "A new curve begins with each stage or start; misfits of stages are not the same sum."));
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
        html("section", { class: "card full" }, html("h3", {}, "Estimates"), this.result, this.sure, this.warnings), this.residualsBox, this.courseBox, this.ellipseBox));
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
  }

  /** No observations: another scene altogether. */
  clear(): void {
    this.end("");
    this.csv = "";
    this.fit = {};
    this.estimate = undefined;
    this.course = [];
    this.choose.value = this.file.value = this.about.textContent = "";
    this.app.data = { quantity: "point", understood: "", notes: [], rows: [] };
    this.showAll();
  }
  private showAll(): void {
    this.showUnknowns();
    this.showResult();
    this.showResiduals();
    this.showCourse();
  }

  /** A fit file: what it says but the files it names, which are opened by themselves. */
  openFit(fit: Table, name: string): void {
    const { start, ...unknown } = fit["unknown"] as Table;
    this.fit = { ...fit, unknown };
    const names = unknown["parameters"];
    if (Array.isArray(start) && Array.isArray(names)) this.app.change(withValues(this.app.scene, names.map(String), start.map(Number)));
    if (this.csv === "") this.about.textContent = `${name}: what is unknown is set; open its observations and its scene too.`;
    this.estimate = undefined;
    this.showAll();
  }

  openDataSet(data: DataSet): void {
    this.clear();
    const fit = readScene(datasets[data.fit]!);
    const scene = readScene(datasets[data.scene]!);
    const { start, ...unknown } = fit["unknown"] as Table;
    this.fit = { ...fit, unknown };
    this.app.open(Array.isArray(start) ? withValues(scene, unknown["parameters"] as string[], start.map(Number)) : scene);
    this.openCsv(datasets[data.observations]!, data.name);
    this.choose.value = String(DATASETS.indexOf(data));
  }

  openCsv(csv: string, name: string): void {
    this.end("");
    this.choose.value = "";
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
    this.course = [];
    const last = Math.max(...data.rows.map((r) => r.t));
    this.app.setTimeShown(Number((last * 1.05).toPrecision(2)));
    this.showAll();
  }

  /** What the engine is asked: a fit file without the files it names, which the engine has. */
  private get task(): string {
    const { scene: _, observations: __, ...rest } = this.fitting;
    return writeScene(rest);
  }
  /** The fit file, as far as it goes with the bed: layers may have come and gone since. */
  private get fitting(): Table {
    if (!this.fit["unknown"]) return this.fit;
    const unknown = unknownOf(this.app.scene, this.fit["unknown"] as Table);
    const isEmpty = Array.isArray(unknown["parameters"]) && unknown["parameters"].length === 0 && unknown !== this.fit["unknown"];
    return { ...this.fit, unknown: isEmpty ? this.usualUnknowns : unknown };
  }
  private get usualUnknowns(): Table {
    const names = ["shear_rate.values", "shear_rate.amplitude", "shear_rate.decay"];
    return { parameters: names.filter((n) => fieldsOf(this.app.scene).includes(n)) };
  }
  /** The fit file of the program. */
  get fitToml(): string {
    return writeScene({ name: String(this.app.scene["name"] ?? "fit"), unknown: this.usualUnknowns, ...this.fitting, scene: "scene.toml", observations: "observations.csv" });
  }
  get observationsCsv(): string {
    return this.csv;
  }

  private get chosen(): string[] {
    return ((this.fitting["unknown"] as Table | undefined)?.["parameters"] as string[] | undefined) ?? [];
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
    this.unknowns.replaceChildren(...(fields.length > 0 ? [html("span", {}, "to be found: ")] : []), ...fields.map((name) => {
      const box = html("input", { type: "checkbox", value: name, ...(this.chosen.includes(name) ? { checked: true } : {}) });
      box.addEventListener("change", () => {
        const parameters = box.checked ? [...this.chosen, name] : this.chosen.filter((n) => n !== name);
        this.fit = { ...this.fitting, unknown: { parameters } }; // bounds and shape belong to those of before
        this.showUnknowns();
        this.showResiduals();
      });
      return html("label", { class: "check", title: name }, box, parameterInWords(this.app.scene, name));
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
      this.state.textContent = `evaluation ${news.evaluations}, misfit ${brief(news.misfit)}: ${expanded(scene, names).map((n, i) => `${parameterInWords(scene, n)} ${brief(news.values[i]!)}`).join(", ")}`;
      this.courseBox.hidden = false;
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
    this.showAll();
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
    if (!estimate) this.result.replaceChildren();
    this.ellipseBox.hidden = !estimate || estimate.parameters.length < 2;
    this.sure.textContent = "";
    this.warnings.replaceChildren(...(estimate?.warnings ?? []).map((w) => html("li", {}, w)));
    if (!estimate) return;
    const interval = (p: Estimate["parameters"][number]): string =>
      Number.isFinite(p.low) ? `${brief(p.low)} to ${brief(p.high)}${percent(p) && ` (${percent(p)})`}` : Number.isFinite(p.profileLow) || Number.isFinite(p.profileHigh) ? `${brief(p.profileLow)} to ${brief(p.profileHigh)} (profile)` : p.atBound ? "at a bound" : "none";
    this.result.replaceChildren(
      html("thead", {}, html("tr", {}, ...["unknown", "start", "estimate", "std error", "95 % interval"].map((h) => html("th", { scope: "col" }, h)))),
      html("tbody", {}, ...estimate.parameters.map((p) => html("tr", {}, html("th", { scope: "row" }, parameterInWords(this.app.scene, p.name), html("span", { class: "code" }, ` ${p.name}`)),
        ...[brief(p.start), brief(p.estimate), Number.isFinite(p.error) ? brief(p.error) : "none", interval(p)].map((x) => html("td", { class: "number" }, x))))));
    const names = estimate.parameters.map((p) => parameterInWords(this.app.scene, p.name));
    const bounded = estimate.parameters.filter((p) => percent(p) !== "" && p.estimate !== 0).sort((a, b) => a.error / Math.abs(a.estimate) - b.error / Math.abs(b.estimate));
    const [best, worst] = [bounded[0], bounded.at(-1)];
    if (best && worst && best !== worst)
      this.sure.textContent = `Known best: ${parameterInWords(this.app.scene, best.name)}, ${percent(best)}; worst: ${parameterInWords(this.app.scene, worst.name)}, ${percent(worst)}` + (estimate.warnings.length > 0 ? ". But read the warnings." : ".");
    this.pair.a.replaceChildren(...names.map((n, i) => html("option", { value: i }, n)));
    this.pair.b.replaceChildren(...names.map((n, i) => html("option", { value: i, ...(i === 1 ? { selected: true } : {}) }, n)));
    this.showEllipse();
  }

  private showEllipse(): void {
    if (this.estimate && this.estimate.parameters.length > 1) drawEllipse(this.charts.ellipse, { ...this.estimate, parameters: this.estimate.parameters.map((p) => ({ ...p, name: parameterInWords(this.app.scene, p.name) })) }, Number(this.pair.a.value), Number(this.pair.b.value));
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
    this.residualsBox.hidden = points.length === 0;
    this.element.dataset["rms"] = String(drawResiduals(this.charts.residuals, points, this.app.picture.facts));
  }

  private showCourse(): void {
    this.courseBox.hidden = this.course.length === 0;
    drawCourse(this.charts.course, this.course);
  }
}
