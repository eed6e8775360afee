// SPDX-License-Identifier: BSD-3-Clause
// The card of a guided scene, and the way from one to the next.
import { GUIDED, type GuidedScene } from "./scenes.ts";
import { prose } from "../view/prose.ts";
import { html } from "../view/svg.ts";

export interface Guide {
  element: HTMLElement;
  select: HTMLSelectElement;
  show(scene: GuidedScene | undefined): void;
  /** The bed is no longer the one that is spoken of. */
  setChanged(isChanged: boolean): void;
}

export function makeGuide(open: (scene: GuidedScene) => void): Guide {
  const select = html("select", { id: "guided", "aria-label": "guided scene" }, html("option", { value: "" }, "own scene"), ...GUIDED.map((g, i) => html("option", { value: g.id }, `${i + 1}. ${g.title}`)));
  const title = html("h2");
  const text = html("p", { id: "guide-text" });
  const question = html("p", { class: "question" });
  const answer = html("details", {}, html("summary", {}, "an answer"), html("p"));
  const before = html("button", { type: "button", id: "guide-before" }, "◀ before");
  const next = html("button", { type: "button", id: "guide-next" }, "next ▶");
  const again = html("button", { type: "button", id: "guide-again", hidden: true }, "↺ as it was");
  const element = html("section", { id: "guide", "aria-label": "Guided scene" }, title, text, question, answer, html("div", { class: "row" }, before, next, again));
  let index = 0;
  const go = (to: number): void => open(GUIDED[(to + GUIDED.length) % GUIDED.length]!);
  before.addEventListener("click", () => go(index - 1));
  next.addEventListener("click", () => go(index + 1));
  again.addEventListener("click", () => go(index));
  select.addEventListener("change", () => {
    const chosen = GUIDED.find((g) => g.id === select.value);
    if (chosen) open(chosen);
  });
  return {
    element, select,
    setChanged(isChanged) {
      again.hidden = !isChanged;
    },
    show(scene) {
      select.value = scene?.id ?? "";
      element.hidden = !scene;
      if (!scene) return;
      index = GUIDED.indexOf(scene);
      title.textContent = `${index + 1}. ${scene.title}`;
      text.replaceChildren(...prose(scene.sentences.join(" ")));
      question.replaceChildren(...prose(scene.question));
      answer.open = false;
      answer.querySelector("p")!.replaceChildren(...prose(scene.answer));
    },
  };
}
