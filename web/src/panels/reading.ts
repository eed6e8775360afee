// SPDX-License-Identifier: BSD-3-Clause
// The picture for those who do not see it: event times and a profile in words and numbers.
import type { App } from "../app.ts";
import { phiInWords } from "../bed/words.ts";
import { spread } from "../bed/picture.ts";
import { brief } from "../view/numbers.ts";
import { planeInWords } from "../view/plane.ts";
import { html } from "../view/svg.ts";

export function reading(app: App): HTMLElement {
  const words = html("p", { id: "reading-words" });
  const body = html("tbody");
  const caption = html("caption");
  const details = html("details", { id: "reading" }, html("summary", {}, "The picture in words and numbers"), words,
    html("table", {}, caption, html("thead", {}, html("tr", {}, ...["z", "φ", "M"].map((h) => html("th", { scope: "col" }, h)))), body));
  const fill = (): void => {
    if (!details.open) return;
    const { picture, t } = app;
    words.textContent = planeInWords(picture, app.times, String(app.scene["name"] ?? "A bed"), phiInWords(app.scene));
    caption.textContent = `φ and M = ∫ φ dz at t = ${brief(t)}`;
    const z = spread(picture.facts.bottom, picture.facts.top, 11);
    try {
      const { phi, M } = app.engine.solve(picture.method, [t], z);
      body.replaceChildren(...z.map((height, i) => html("tr", {}, ...[height, phi[i]!, M[i]!].map((x) => html("td", { class: "number" }, brief(x))))).reverse());
    } catch (error) {
      words.textContent = (error as Error).message;
    }
  };
  details.addEventListener("toggle", fill);
  app.listen({ sceneChanged: (isDrag) => { if (!isDrag) fill(); }, timeChanged: fill });
  return details;
}
