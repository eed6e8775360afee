// SPDX-License-Identifier: BSD-3-Clause
// Event times by their names, and what they mean.
import type { EventTimes } from "../engine/engine.ts";
import { brief } from "../view/numbers.ts";

export interface NamedTime {
  id: string; // "t_c(1)"
  formula: string; // key of formulas.json
  index: string; // of several interfaces
  meaning: string;
  t: number;
  z: number | undefined; // where it happens
}

/** In the order of the program's table. */
export function namedTimes(events: EventTimes, top: number, bottom: number): NamedTime[] {
  const at = events.interfaces.filter((i) => i.jumps);
  const index = (k: number): string => (at.length > 1 ? `(${k + 1})` : "");
  return [
    ...at.map((i, k) => ({ id: "t_c" + index(k), formula: "t_c", index: index(k), t: i.first, z: i.z,
      meaning: `first wave at the interface z = ${brief(i.z)}` })),
    { id: "t_0", formula: "t_0", index: "", meaning: "first wave at the bottom", t: events.t0, z: bottom },
    { id: "t_1", formula: "t_1", index: "", meaning: "first wave at the top", t: events.t1, z: top },
    ...at.map((i, k) => ({ id: "t^_c" + index(k), formula: "t^_c", index: index(k), t: i.last, z: i.z,
      meaning: `last change at the interface z = ${brief(i.z)}` })),
    { id: "t*", formula: "t*", index: "", meaning: "steady state: nothing moves any more", t: events.tStar, z: undefined },
  ];
}
