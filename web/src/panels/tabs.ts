// SPDX-License-Identifier: BSD-3-Clause
// Tabs as ARIA has them: one in the tab order, arrows between them.
import { html, set } from "../view/svg.ts";

export interface Tab {
  id: string;
  title: string;
  content: HTMLElement;
  enter?(): void;
  leave?(): void;
}

export interface Tabs {
  element: HTMLElement;
  readonly shown: string;
  show(id: string): void;
}

export function makeTabs(tabs: Tab[]): Tabs {
  let shown = "";
  const buttons = tabs.map((t) => html("button", { type: "button", role: "tab", id: `tab-${t.id}`, "aria-controls": `panel-${t.id}` }, t.title));
  const panels = tabs.map((t) => html("div", { role: "tabpanel", id: `panel-${t.id}`, "aria-labelledby": `tab-${t.id}` }, t.content));
  const show = (id: string): void => {
    if (id === shown) return;
    const before = tabs.find((t) => t.id === shown);
    shown = id;
    tabs.forEach((t, i) => {
      const isOn = t.id === id;
      set(buttons[i]!, { "aria-selected": isOn ? "true" : "false", tabindex: isOn ? 0 : -1 });
      panels[i]!.hidden = !isOn;
    });
    before?.leave?.();
    tabs.find((t) => t.id === id)?.enter?.();
  };
  buttons.forEach((button, i) => {
    button.addEventListener("click", () => show(tabs[i]!.id));
    button.addEventListener("keydown", (event) => {
      const by = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
      if (by === 0) return;
      const to = (i + by + tabs.length) % tabs.length;
      show(tabs[to]!.id);
      buttons[to]!.focus();
    });
  });
  return {
    element: html("section", { id: "tabs" }, html("div", { role: "tablist", "aria-label": "Tools" }, ...buttons), ...panels),
    get shown() {
      return shown;
    },
    show,
  };
}
