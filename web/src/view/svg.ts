// SPDX-License-Identifier: BSD-3-Clause
// Elements made and kept: small helpers for SVG and HTML.

type Attributes = Record<string, string | number | boolean | undefined>;
const SVG = "http://www.w3.org/2000/svg";

export function set(element: Element, attributes: Attributes): void {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) element.removeAttribute(key);
    else if (element.getAttribute(key) !== String(value)) element.setAttribute(key, String(value));
  }
}

export function svg<K extends keyof SVGElementTagNameMap>(name: K, attributes: Attributes = {}, text?: string): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, name);
  set(element, attributes);
  if (text !== undefined) element.textContent = text;
  return element;
}

export function html<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  set(element, attributes);
  element.append(...children);
  return element;
}

/** One child per item, kept from call to call by its key, so that focus and pointer stay. */
export function join<T, E extends Element>(
  parent: Element,
  items: readonly T[],
  key: (item: T) => string,
  create: (item: T) => E,
  update: (element: E, item: T) => void,
): void {
  const before = new Map(Array.from(parent.children, (child) => [child.getAttribute("data-key"), child as E]));
  let place: Element | null = parent.firstElementChild;
  for (const item of items) {
    const k = key(item);
    let element = before.get(k);
    if (!element) {
      element = create(item);
      element.setAttribute("data-key", k);
    }
    before.delete(k);
    update(element, item);
    if (element === place) place = place.nextElementSibling;
    else parent.insertBefore(element, place);
  }
  for (const gone of before.values()) gone.remove();
}

/** Path through points; NaN lifts the pen. */
export function path(points: Iterable<readonly [number, number]>): string {
  let d = "";
  let pen = "M";
  for (const [x, y] of points) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) {
      pen = "M";
      continue;
    }
    d += `${pen}${x.toFixed(1)} ${y.toFixed(1)}`;
    pen = "L";
  }
  return d;
}
