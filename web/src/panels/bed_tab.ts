// SPDX-License-Identifier: BSD-3-Clause
// The bed in numbers: layers, start, flux, ends. Everything that can be dragged, and what cannot.
import formulas from "virtual:formulas";
import type { App } from "../app.ts";
import * as edit from "../bed/edits.ts";
import { fluxOf, hasManyFluxes, hasSteps, number, numbers, rateModel, scaleOf, type Scene, table, type Table } from "../bed/scene.ts";
import { brief } from "../view/numbers.ts";
import { html } from "../view/svg.ts";

function field(label: string, value: number, apply: (x: number) => void, id: string): HTMLElement {
  const input = html("input", { type: "number", step: "any", value, id, "aria-label": label });
  input.addEventListener("change", () => {
    if (Number.isFinite(input.valueAsNumber)) apply(input.valueAsNumber);
  });
  return html("label", { class: "field" }, label, input);
}

function choice(label: string, options: readonly string[], chosen: string, apply: (x: string) => void, id: string): HTMLElement {
  const select = html("select", { id }, ...options.map((o) => html("option", { value: o, ...(o === chosen ? { selected: true } : {}) }, o)));
  if (!options.includes(chosen)) select.prepend(html("option", { value: chosen, selected: true }, chosen));
  select.addEventListener("change", () => apply(select.value));
  return html("label", { class: "field" }, label, select);
}

function button(text: string, act: () => void, id: string, label = text): HTMLButtonElement {
  const element = html("button", { type: "button", id, "aria-label": label, title: label }, text);
  element.addEventListener("click", act);
  return element;
}

function box(title: string, ...children: (Node | string)[]): HTMLElement {
  return html("fieldset", {}, html("legend", {}, title), ...children);
}

function rateBox(app: App): HTMLElement {
  const { scene } = app;
  const model = rateModel(scene);
  const rate = table(scene, "shear_rate");
  const speeds = app.picture.rate.z.map((z, i) => ({ z, speed: app.picture.rate.speed[i]! }));
  const parts: Node[] = [choice("a(z)", ["piecewise", "exponential", "table"], model, (to) => app.change(edit.setRateModel(app.scene, to, speeds)), "rate-model")];
  if (model === "piecewise") {
    const breaks = numbers(rate, "breaks");
    const values = numbers(rate, "values");
    const rows = values.map((a, i) => html("div", { class: "row" },
      field(`layer ${i + 1}: a`, a, (x) => app.change(edit.setRateEntry(app.scene, "values", values.map((v, k) => (k === i ? x : v)))), `rate-${i}`),
      i < breaks.length ? field("up to z", breaks[i]!, (z) => app.change(edit.moveInterface(app.scene, i, z)), `break-${i}`) : html("span", { class: "note" }, "up to the top"),
      html("span", { class: "tools" }, button("÷", () => app.change(edit.addLayer(app.scene, i)), `split-layer-${i}`, `cut layer ${i + 1} in two`),
        values.length > 1 ? button("×", () => app.change(edit.removeLayer(app.scene, i)), `remove-layer-${i}`, `remove layer ${i + 1}`) : ""))).reverse();
    parts.push(...rows, button("add a layer", () => app.change(edit.addLayer(app.scene)), "add-layer"));
  } else if (model === "exponential") {
    for (const key of ["amplitude", "decay"])
      parts.push(field(key, number(rate, key, 1), (x) => app.change(edit.setRateEntry(app.scene, key, x)), `rate-${key}`));
  }
  parts.push(field("scale s", scaleOf(scene), (x) => app.change(edit.setRateEntry(app.scene, "scale", x)), "rate-scale"));
  parts.push(button("draw a(z) by hand", () => app.drawByHand(true), "draw-rate"));
  return box("Shear rate", ...parts);
}

function startBox(app: App): HTMLElement {
  const { scene } = app;
  if (!hasSteps(scene)) return box("Start", html("p", { class: "note" }, "This start is a smooth function of its file; it is kept as it is."));
  const start = table(scene, "initial");
  const breaks = numbers(start, "breaks");
  const values = numbers(start, "values");
  const { lowest, highest } = app.picture.facts;
  const rows = values.map((phi, i) => html("div", { class: "row" },
    field(`piece ${i + 1}: φ`, phi, (x) => app.change(edit.setState(app.scene, i, x, lowest, highest)), `start-${i}`),
    i < breaks.length ? field("up to z", breaks[i]!, (z) => app.change(edit.moveJump(app.scene, i, z)), `start-break-${i}`) : html("span", { class: "note" }, "up to the top"),
    i > 0 ? html("span", { class: "tools" }, button("×", () => app.change(edit.removeJump(app.scene, i - 1)), `remove-jump-${i - 1}`, `remove jump ${i}`)) : "")).reverse();
  return box("Start φ(z, 0)", ...rows, button("add a jump", () => app.change(edit.addJump(app.scene, lowest, highest)), "add-jump"));
}

function fluxBox(app: App): HTMLElement {
  const { scene } = app;
  const flux = fluxOf(scene);
  const model = String(flux["model"] ?? "quadratic");
  const formula = html("p", { class: "formula" });
  formula.innerHTML = formulas[`flux ${model}`] ?? "";
  const at = numbers(flux, "phi");
  const points = numbers(flux, "values").map((value, i, all) =>
    field(`f(${brief(at[i] ?? NaN)})`, value, (x) => app.change(edit.setFluxEntry(app.scene, "values", all.map((v, k) => (k === i ? x : v)))), `flux-point-${i}`));
  const entries = Object.entries(flux).filter(([, value]) => typeof value === "number");
  return box("Flux",
    choice("f(φ)", edit.FLUX_NAMES, model, (to) => app.change(edit.setFlux(app.scene, to)), "flux-model"), formula,
    ...entries.map(([key, value]) => field(key, Number(value), (x) => app.change(edit.setFluxEntry(app.scene, key, x)), `flux-${key}`)), ...points,
    ...(edit.needsOneRate(model) ? [html("p", { class: "note" }, "Its bed has one rate everywhere: the flux does not vanish at the ends of its states, so no interface passes it on.")] : []),
    ...(hasManyFluxes(scene) ? [html("p", { class: "note" }, "Layers of this bed have fluxes of their own; choosing one replaces them all.")] : []));
}

function endsBox(app: App): HTMLElement {
  const { scene } = app;
  const ends = edit.endsOf(scene);
  const flux = String(fluxOf(scene)["model"] ?? "quadratic");
  const boundary = table(scene, "boundary");
  const outside = (["top", "bottom"] as const).flatMap((end) =>
    numbers((boundary[end] as Table | undefined) ?? {}, "values").map((value, i, all) =>
      field(`beyond the ${end}${all.length > 1 ? `, ${i + 1}` : ""}: φ`, value, (x) => app.change(edit.setOutside(app.scene, end, i, x)), `outside-${end}-${i}`)));
  const note = edit.needsOpenEnds(flux) ? [html("p", { class: "note" }, "No wall holds this flux: it does not vanish at the ends of its states.")] : [];
  return box("Ends", choice("ends", ["walls", "open", "periodic"], ends, (to) => app.change(edit.setEnds(app.scene, to as edit.Ends)), "ends"), ...(ends === "open" ? outside : []), ...note);
}

export function bedTab(app: App): HTMLElement {
  const tab = html("div", { class: "boxes" });
  let shown: Scene | undefined;
  const fill = (): void => {
    if (shown === app.scene) return;
    shown = app.scene;
    const focus = document.activeElement?.id;
    tab.replaceChildren(rateBox(app), startBox(app), fluxBox(app), endsBox(app));
    if (focus) tab.querySelector<HTMLElement>(`#${CSS.escape(focus)}`)?.focus();
  };
  app.listen({ sceneChanged: (isDrag) => { if (!isDrag) fill(); } });
  fill();
  return tab;
}
