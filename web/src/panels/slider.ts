// SPDX-License-Identifier: BSD-3-Clause
// A slider over a logarithmic range, with its number.
import { brief } from "../view/numbers.ts";
import { html } from "../view/svg.ts";

export interface Slider {
  element: HTMLElement;
  readonly value: number;
  set(value: number): void;
}

export function logSlider(id: string, label: string, low: number, high: number, start: number, tidy: (x: number) => number, changed: (x: number) => void): Slider {
  const input = html("input", { type: "range", id, min: 0, max: 1000, step: 1 });
  const shown = html("output", { for: id });
  let value = start;
  const show = (): void => {
    shown.textContent = brief(value);
    input.setAttribute("aria-valuetext", brief(value));
  };
  const set = (x: number): void => {
    value = x;
    input.value = String((1000 * Math.log(x / low)) / Math.log(high / low));
    show();
  };
  input.addEventListener("input", () => {
    value = tidy(low * (high / low) ** (input.valueAsNumber / 1000));
    show();
    changed(value);
  });
  set(start);
  return {
    element: html("label", { class: "field wide", for: id }, label, input, shown),
    get value() {
      return value;
    },
    set,
  };
}
