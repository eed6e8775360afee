// SPDX-License-Identifier: BSD-3-Clause
// Event times: name, meaning, and every digit.
import formulas from "virtual:formulas";
import type { App } from "../app.ts";
import { whyOf } from "../bed/why.ts";
import { unitsOf } from "../bed/scene.ts";
import { brief, full } from "../view/numbers.ts";
import { prose } from "../view/prose.ts";
import { html, join, set } from "../view/svg.ts";

export function eventsTable(app: App): HTMLElement {
  const body = html("tbody");
  const note = html("p", { class: "note", id: "events-note" });
  const head = html("tr", {}, ...["event", "meaning", "time"].map((text) => html("th", { scope: "col" }, text)));
  const caption = html("caption", {}, "Event times");
  const grid = html("table", {}, caption, html("thead", {}, head), body);
  const section = html("section", { id: "events", "aria-label": "Event times" }, grid, note);

  const said = html("p", { class: "unseen", role: "status" });
  section.append(said);
  const opened = new Set<string>();
  const fill = (isDrag = false): void => {
    if (!isDrag) said.textContent = app.times.map((m) => `${m.id} ${brief(m.t)}`).join(", ");
    const unit = unitsOf(app.scene).t;
    head.lastElementChild!.textContent = unit ? `time [${unit}]` : "time";
    const rows = app.times.flatMap((m) => [{ m, isWhy: false }, { m, isWhy: true }]);
    join(body, rows, ({ m, isWhy }) => `${m.id} ${isWhy}`, () => html("tr"), (row, { m, isWhy }) => {
      if (isWhy) {
        row.className = "why";
        row.hidden = !opened.has(m.id);
        row.replaceChildren(html("td", { colspan: 3, id: `why-${m.id}` }, ...(row.hidden ? [] : prose(whyOf(app.scene, app.picture, m)))));
        return;
      }
      const symbol = html("th", { scope: "row" });
      symbol.innerHTML = formulas[m.formula]! + (m.index && `<span class="index">${m.index}</span>`);
      const time = html("td", { class: "number", "data-event": m.id }, full(m.t));
      const explain = html("button", { type: "button", class: "explain", "aria-expanded": String(opened.has(m.id)), "aria-controls": `why-${m.id}` }, m.meaning);
      explain.addEventListener("click", () => {
        if (!opened.delete(m.id)) opened.add(m.id);
        fill(true);
        body.querySelector<HTMLElement>(`[aria-controls="why-${CSS.escape(m.id)}"]`)?.focus();
      });
      const before = app.timesBefore.get(m.id);
      const was = before === undefined || before === m.t ? "" : html("span", { class: "note was" }, `was ${brief(before)}`);
      row.replaceChildren(symbol, html("td", {}, explain, was), time);
      if (!Number.isFinite(m.t)) return;
      const go = html("button", { type: "button", title: `show φ at ${m.id}`, "aria-label": `${full(m.t)}: show the profile at ${m.id}` }, full(m.t));
      go.addEventListener("click", () => app.setTime(m.t));
      time.replaceChildren(go);
    });
    grid.hidden = app.times.length === 0;
    note.textContent = (app.picture.noEvents && `No event times: ${app.picture.noEvents}.`) || (app.picture.method === "exact" ? "" : `By front tracking, first order in its fans: ${app.engine.refusal("exact")}`);
    set(note, { hidden: note.textContent === "" });
  };
  const choose = (id: string): void => {
    opened.add(id);
    fill(true);
    document.getElementById(`why-${id}`)?.scrollIntoView({ block: "nearest" });
  };
  app.listen({ sceneChanged: fill, eventChosen: choose });
  fill();
  return section;
}
