// SPDX-License-Identifier: BSD-3-Clause
// Sentences with the names of times and of constants set as such: t_c, t^_c, t*, z0, k1.
import { html } from "./svg.ts";

const NAME = /t\^_c|t_[c01]|t\*|\b(?:z[0c]|k[01])\b/g;

function named(name: string): HTMLElement {
  const letter = html("i", {}, name.startsWith("t^") ? "t\u0302" : name[0]!);
  const rest = name.replace(/^t\^?_?|^[zk]/, "");
  return html("span", { class: "name" }, letter, html(rest === "*" ? "sup" : "sub", {}, rest));
}

export function prose(text: string): (Node | string)[] {
  const parts: (Node | string)[] = [];
  let from = 0;
  for (const match of text.matchAll(NAME)) {
    parts.push(text.slice(from, match.index), named(match[0]));
    from = match.index + match[0].length;
  }
  return [...parts, text.slice(from)].filter((part) => part !== "");
}
