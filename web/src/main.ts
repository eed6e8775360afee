// SPDX-License-Identifier: BSD-3-Clause
// The page: starts the engine, puts the parts together.
import engineLetters from "virtual:engine";
import formulas from "virtual:formulas";
import { App } from "./app.ts";
import { fromHash, fromLetters, gunzip } from "./bed/link.ts";
import { textOf } from "./bed/files.ts";
import { readScene, unitsOf } from "./bed/scene.ts";
import { Engine } from "./engine/engine.ts";
import { makeGuide } from "./guide/guide.ts";
import { GUIDED, type GuidedScene } from "./guide/scenes.ts";
import { bedTab } from "./panels/bed_tab.ts";
import { CollisionsTab } from "./panels/collisions_tab.ts";
import { eventsTable } from "./panels/events_table.ts";
import { DATASETS, FitTab } from "./panels/fit_tab.ts";
import { MethodsTab } from "./panels/methods_tab.ts";
import { reading } from "./panels/reading.ts";
import { saveMenu } from "./panels/save.ts";
import { makeTabs, type Tabs } from "./panels/tabs.ts";
import { phiInWords } from "./bed/words.ts";
import { brief, withUnit } from "./view/numbers.ts";
import { prose } from "./view/prose.ts";
import { html } from "./view/svg.ts";
import "./style.css";

function button(id: string, text: string, label: string, act: () => void): HTMLButtonElement {
  const element = html("button", { type: "button", id, "aria-label": label, title: label }, text);
  element.addEventListener("click", act);
  return element;
}

function themeChoice(): HTMLElement {
  const select = html("select", { id: "theme", "aria-label": "colours of the page" }, ...["auto", "light", "dark"].map((t) => html("option", {}, t)));
  const apply = (theme: string): void => {
    if (theme === "auto") delete document.documentElement.dataset["theme"];
    else document.documentElement.dataset["theme"] = theme;
  };
  select.addEventListener("change", () => apply(select.value));
  return select;
}

function timeBar(app: App): HTMLElement {
  const slider = html("input", { type: "range", id: "time", min: 0, max: 1000, step: 1, "aria-label": "time shown in the profile" });
  const shown = html("output", { for: "time", id: "time-shown" });
  const end = html("input", { type: "number", id: "time-end", min: 0, step: "any", "aria-label": "end of the time axis, empty for automatic", placeholder: "auto" });
  const fronts = html("input", { type: "checkbox", id: "fronts", checked: true });
  slider.addEventListener("input", () => app.setTime((slider.valueAsNumber / 1000) * app.picture.tMax));
  end.addEventListener("change", () => app.setTimeShown(Number.isFinite(end.valueAsNumber) ? end.valueAsNumber : undefined));
  fronts.addEventListener("change", () => {
    app.showFronts = fronts.checked;
    app.draw();
  });
  const show = (): void => {
    const text = withUnit(brief(app.t), unitsOf(app.scene).t);
    slider.value = String((1000 * app.t) / app.picture.tMax);
    slider.setAttribute("aria-valuetext", `t = ${text}`);
    shown.textContent = `t = ${text}`;
    if (document.activeElement !== end) end.value = app.timeShown === undefined ? "" : String(app.timeShown);
  };
  app.listen({ sceneChanged: show, timeChanged: show });
  show();
  return html("div", { id: "timebar", class: "row" }, slider, shown, html("label", { class: "field" }, "shown until t", end), html("label", { class: "check" }, fronts, "fronts"), html("span", { id: "state", class: "note" }));
}

/** What the colours stand for, and how to read the plane. */
function scaleBar(app: App): HTMLElement {
  const [low, high, meaning] = [html("span"), html("span"), html("span")];
  const show = (): void => {
    const { lowest, highest } = app.picture.facts;
    [low.textContent, high.textContent] = [brief(lowest), brief(highest)];
    const words = phiInWords(app.scene);
    meaning.textContent = words ? `φ, ${words}:` : "φ:";
  };
  app.listen({ sceneChanged: show });
  show();
  return html("div", { id: "scale" }, meaning, " ", low, " ", html("span", { class: "bar", "aria-hidden": "true" }), " ", high,
    html("span", { class: "hint" }, "Thin lines: waves of a fan; thick: shocks; dashed: interfaces, and in the profile the start. Drag the white knobs, move over the plane to choose t, press a time such as ", ...prose("t_1"), " to read why."));
}

function listenToKeys(app: App): void {
  document.addEventListener("keydown", (event) => {
    const isText = event.target instanceof HTMLInputElement && event.target.type !== "range" && event.target.type !== "checkbox";
    if (!(event.ctrlKey || event.metaKey) || isText) return;
    const key = event.key.toLowerCase();
    if (key === "z" && !event.shiftKey) app.undo();
    else if (key === "y" || (key === "z" && event.shiftKey)) app.redo();
    else return;
    event.preventDefault();
  });
}

/** Files are opened wherever they are dropped: a scene first, then observations, then the fit of both. */
function listenToDrops(app: App, fit: FitTab, tabs: () => Tabs, opened: () => void): (files: Iterable<File>) => Promise<void> {
  const open = (name: string, text: string): void => {
    if (!/\.toml$/i.test(name)) {
      tabs().show("fit");
      return fit.openCsv(text, name);
    }
    const content = readScene(text);
    if (content["unknown"]) {
      tabs().show("fit");
      return fit.openFit(content, name);
    }
    app.open(content);
    opened();
  };
  const take = async (files: Iterable<File>): Promise<void> => {
    const texts = await Promise.all(Array.from(files, async (file) => ({ name: file.name, text: await textOf(file) })));
    const order = ({ name, text }: { name: string; text: string }): number => (!/\.toml$/i.test(name) ? 1 : /^\s*\[unknown\]|^\s*unknown\s*[.=]/m.test(text) ? 2 : 0);
    for (const { name, text } of texts.sort((a, b) => order(a) - order(b))) {
      try {
        open(name, text);
      } catch (error) {
        app.complaint = `${name}: ${(error as Error).message}`;
        showComplaint(app);
      }
    }
  };
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    void take(event.dataTransfer?.files ?? []);
  });
  return take;
}

function showComplaint(app: App): void {
  const box = document.getElementById("complaint")!;
  box.textContent = app.complaint;
  box.hidden = app.complaint === "";
}

function header(app: App, fit: FitTab, guided: HTMLElement, take: (files: Iterable<File>) => Promise<void>): HTMLElement {
  const undo = button("undo", "↶", "undo", () => app.undo());
  const redo = button("redo", "↷", "redo", () => app.redo());
  const link = button("link", "copy link", "copy a link to this scene", () => {
    void app.share().then(() => navigator.clipboard.writeText(location.href)).then(() => (link.textContent = "copied"), () => (link.textContent = "in the address"));
    setTimeout(() => (link.textContent = "copy link"), 1500);
  });
  const file = html("input", { type: "file", id: "open-file", accept: ".toml,.csv,.txt", multiple: true, hidden: true });
  file.addEventListener("change", () => void take(file.files ?? []).then(() => (file.value = "")));
  const open = button("open", "open", "open a scene, observations, a fit file, or all three", () => file.click());
  const show = (): void => {
    undo.disabled = !app.history.canUndo;
    redo.disabled = !app.history.canRedo;
    showComplaint(app);
  };
  app.listen({ sceneChanged: show });
  undo.disabled = redo.disabled = true;
  const law = html("span", { class: "formula", id: "law" });
  law.innerHTML = formulas["law"]!;
  return html("header", {}, html("h1", {}, "shearfront"), law, html("div", { class: "row", role: "toolbar", "aria-label": "Scene" }, guided, undo, redo, open, file, link, saveMenu(app, fit), themeChoice()));
}

async function start(): Promise<void> {
  const module = await WebAssembly.compile(await gunzip(fromLetters(engineLetters)));
  const engine = new Engine(module);
  const linked = await fromHash(location.hash);
  const first = GUIDED[0]!;
  let app: App;
  let isLinked = linked !== undefined && linked !== first.toml;
  let broken = location.hash.startsWith("#s=") && linked === undefined ? "This link holds no scene that can be read: was it cut off?" : "";
  try {
    app = new App(engine, module, linked ?? first.toml);
  } catch (error) {
    broken = `The scene of this link cannot be used: ${(error as Error).message}`;
    isLinked = false;
    app = new App(engine, module, first.toml);
  }
  const fit = new FitTab(app, () => guide.show(undefined));
  let tabs: Tabs;
  const methods = new MethodsTab(app, () => tabs?.shown === "methods");
  const collisions = new CollisionsTab(app, () => tabs?.shown === "collisions");
  tabs = makeTabs([
    { id: "bed", title: "Bed", content: bedTab(app) },
    { id: "methods", title: "Methods", content: methods.element, enter: () => methods.later() },
    { id: "collisions", title: "Collisions", content: collisions.element, enter: () => collisions.enter(), leave: () => collisions.leave() },
    { id: "fit", title: "Fit", content: fit.element },
  ]);
  const openGuided = (scene: GuidedScene): void => {
    const data = DATASETS.find((d) => d.observations === scene.dataset);
    fit.clear();
    if (data) fit.openDataSet(data);
    else app.open(readScene(scene.toml));
    if (scene.timeShown) app.setTimeShown(scene.timeShown);
    app.setTime(scene.t ?? 0.3 * app.picture.tMax);
    guide.show(scene);
    told = app.toml;
    guide.setChanged(false);
    tabs.show(scene.tab);
  };
  const guide = makeGuide(openGuided);
  let told = app.toml;
  app.listen({ sceneChanged: () => guide.setChanged(app.toml !== told) });
  const take = listenToDrops(app, fit, () => tabs, () => guide.show(undefined));
  const complaint = html("p", { id: "complaint", role: "alert", hidden: true });
  const left = html("div", { class: "planes" }, app.plane.figure, app.mixing.figure);
  const scale = scaleBar(app);
  document.body.replaceChildren(
    header(app, fit, guide.select, take), complaint, guide.element,
    html("main", {}, html("div", { id: "panels" }, left, app.profile.figure, app.rate.figure), scale, timeBar(app), html("div", { id: "lower" }, eventsTable(app), tabs.element), reading(app)),
    html("footer", {}, "Computed here, by the engines of shearfront: what you see can be saved as a scene file and run by the program. Nothing leaves this page."),
  );
  app.resize();
  new ResizeObserver(() => app.resize()).observe(document.getElementById("panels")!);
  tabs.show("bed");
  guide.show(isLinked ? undefined : first);
  app.setTime(isLinked ? 0.3 * app.picture.tMax : first.t!);
  listenToKeys(app);
  window.addEventListener("hashchange", () => {
    void fromHash(location.hash).then((toml) => {
      if (toml && toml !== app.toml) {
        app.open(readScene(toml));
        guide.show(undefined);
      }
    });
  });
  app.update(false);
  if (broken) {
    app.complaint = broken;
    showComplaint(app);
  }
  document.documentElement.dataset["ready"] = String(Math.round(performance.now()));
  Object.assign(window, { shearfront: app });
}

void start().catch((error: unknown) => {
  document.body.textContent = `The explorer could not start: ${(error as Error).message}. It needs a browser of 2023 or later.`;
});
