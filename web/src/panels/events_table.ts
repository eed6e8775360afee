// SPDX-License-Identifier: BSD-3-Clause
// Event times: name, meaning, and every digit.
import formulas from "virtual:formulas";
import type { App } from "../app.ts";
import { unitsOf } from "../bed/scene.ts";
import { brief, full } from "../view/numbers.ts";
import { html, join, set } from "../view/svg.ts";

const WHY: Record<string, string> = {
  "t_c": "A wave runs from the jump of the start to the interface: pure grains next to it, so with the speed s a of its layer. Until then the layer beyond does not know of it.",
  "t_0": "The lower edge of the fan of waves meets the bottom. From here on small grains pile up there: a shock rises.",
  "t_1": "The upper edge of the fan meets the top. By now the fan covers nearly the whole bed, and inside a fan both kinds of grains are present at every height: the bed is about as well mixed as it gets. From here on large grains pile up at the top, and a shock of pure large grains runs down. In a fast layer the same flux takes fewer grains, so φ is near 0 or 1 there even inside the fan. The mixing Ψ in the strip goes on rising a little, while the fan flattens, and falls when the shocks take away more.",
  "t^_c": "The last shock has passed the interface.",
  "t*": "The shock from the bottom and that from the top have met: all small grains lie below, all large ones above.",
};

const AT_ONCE = "Both kinds of grains are there from the start, so something moves at once.";

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
        row.replaceChildren(html("td", { colspan: 3, id: `why-${m.id}` }, m.t === 0 && ["t_c", "t_0", "t_1"].includes(m.formula) ? AT_ONCE : WHY[m.formula] ?? ""));
        return;
      }
      const symbol = html("th", { scope: "row" });
      symbol.innerHTML = formulas[m.formula]! + m.index;
      const time = html("td", { class: "number", "data-event": m.id }, full(m.t));
      const explain = html("button", { type: "button", class: "explain", "aria-expanded": String(opened.has(m.id)), "aria-controls": `why-${m.id}` }, m.meaning);
      explain.addEventListener("click", () => {
        if (!opened.delete(m.id)) opened.add(m.id);
        fill(true);
        body.querySelector<HTMLElement>(`[aria-controls="why-${CSS.escape(m.id)}"]`)?.focus();
      });
      row.replaceChildren(symbol, html("td", {}, explain), time);
      if (!Number.isFinite(m.t)) return;
      const go = html("button", { type: "button", title: `show φ at ${m.id}`, "aria-label": `${full(m.t)}: show the profile at ${m.id}` }, full(m.t));
      go.addEventListener("click", () => app.setTime(m.t));
      time.replaceChildren(go);
    });
    grid.hidden = app.times.length === 0;
    note.textContent = (app.picture.noEvents && `No event times: ${app.picture.noEvents}.`) || (app.picture.method === "exact" ? "" : `By front tracking, first order in its fans: ${app.engine.refusal("exact")}`);
    set(note, { hidden: note.textContent === "" });
  };
  app.listen({ sceneChanged: fill });
  fill();
  return section;
}
