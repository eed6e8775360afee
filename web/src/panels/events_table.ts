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
  "t_1": "The upper edge of the fan meets the top. By now the fan covers nearly the whole bed, and inside a fan both kinds of grains are present at every height: the bed is about as well mixed as it gets. From here on large grains pile up at the top, and a shock of pure large grains runs down. The mixing Ψ in the strip goes on rising a little, while the fan flattens, and falls when the shocks take away more.",
  "t^_c": "The last shock has passed the interface.",
  "t*": "The shock from the bottom and that from the top have met: all small grains lie below, all large ones above.",
};

export function eventsTable(app: App): HTMLElement {
  const body = html("tbody");
  const note = html("p", { class: "note", id: "events-note" });
  const head = html("tr", {}, ...["event", "meaning", "time"].map((text) => html("th", { scope: "col" }, text)));
  const caption = html("caption", {}, "Event times");
  const grid = html("table", {}, caption, html("thead", {}, head), body);
  const section = html("section", { id: "events", "aria-label": "Event times" }, grid, note);

  const said = html("p", { class: "unseen", role: "status" });
  section.append(said);
  const fill = (isDrag = false): void => {
    if (!isDrag) said.textContent = app.times.map((m) => `${m.id} ${brief(m.t)}`).join(", ");
    const unit = unitsOf(app.scene).t;
    head.lastElementChild!.textContent = unit ? `time [${unit}]` : "time";
    join(body, app.times, (m) => m.id, () => html("tr"), (row, m) => {
      const symbol = html("th", { scope: "row" });
      symbol.innerHTML = formulas[m.formula]! + m.index;
      const time = html("td", { class: "number", "data-event": m.id }, full(m.t));
      const explain = html("details", {}, html("summary", {}, m.meaning), html("p", {}, WHY[m.formula] ?? ""));
      row.replaceChildren(symbol, html("td", {}, explain), time);
      if (!Number.isFinite(m.t)) return;
      const go = html("button", { type: "button", title: `show φ at ${m.id}`, "aria-label": `show the profile at ${m.id}` }, full(m.t));
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
