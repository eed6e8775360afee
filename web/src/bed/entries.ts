// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a scene by their names in a fit file: "shear_rate.values", "shear_rate.values[1]", "flux.gamma".
import type { Scene, Table, Value } from "./scene.ts";

interface Name {
  table: string;
  key: string;
  index: number | undefined;
}

function parsed(name: string): Name {
  const match = /^([^.]+)\.([^[]+)(?:\[(\d+)\])?$/.exec(name);
  return { table: match?.[1] ?? "", key: match?.[2] ?? "", index: match?.[3] === undefined ? undefined : Number(match[3]) };
}

function lookUp(scene: Scene, { table, key }: Name): Value | undefined {
  const inside = scene[table];
  return inside && typeof inside === "object" && !Array.isArray(inside) ? inside[key] : undefined;
}

/** One name per number. */
export function expanded(scene: Scene, names: readonly string[]): string[] {
  return names.flatMap((name) => {
    const value = lookUp(scene, parsed(name));
    return Array.isArray(value) && parsed(name).index === undefined ? value.map((_, i) => `${name}[${i}]`) : [name];
  });
}

export function withValues(scene: Scene, names: readonly string[], values: ArrayLike<number>): Scene {
  let changed = scene;
  expanded(scene, names).forEach((name, i) => {
    const value = values[i];
    if (value === undefined) return;
    const { table, key, index } = parsed(name);
    const inside = (changed[table] ?? {}) as Table;
    const before = inside[key];
    const after: Value = index !== undefined && Array.isArray(before) ? before.map((x, k) => (k === index ? value : x)) : value;
    changed = { ...changed, [table]: { ...inside, [key]: after } };
  });
  return changed;
}

/** False for what layers, jumps and kinds of a(z) brought with them, and took. */
function isStillIn(scene: Scene, name: string): boolean {
  const { table, key, index } = parsed(name);
  if (!["shear_rate", "initial"].includes(table) || !["values", "breaks", "amplitude", "decay"].includes(key)) return true;
  const value = lookUp(scene, parsed(name));
  return value !== undefined && (index === undefined || (Array.isArray(value) && index < value.length));
}

/** [unknown] of a fit file as far as it goes with a scene: as it is, or the names that are left, without bounds and whatever else counts them. */
export function unknownOf(scene: Scene, unknown: Table): Table {
  const all = Array.isArray(unknown["parameters"]) ? unknown["parameters"].map(String) : [];
  const parameters = all.filter((name) => isStillIn(scene, name));
  const n = expanded(scene, parameters).length;
  const isWhole = parameters.length === all.length && Object.entries(unknown).every(([key, value]) => key === "parameters" || !Array.isArray(value) || value.length === n);
  return isWhole ? unknown : { parameters };
}

/** What of a scene can be unknown. */
export function fieldsOf(scene: Scene): string[] {
  const names: string[] = [];
  for (const [name, value] of Object.entries(scene)) {
    if (typeof value !== "object" || Array.isArray(value) || !["flux", "shear_rate", "initial", "diffusion", "solid_fraction"].includes(name)) continue;
    for (const [key, entry] of Object.entries(value)) {
      const isNumbers = Array.isArray(entry) ? entry.length > 0 && entry.every((x) => typeof x === "number") : typeof entry === "number";
      if (isNumbers && key !== "z" && key !== "phi") names.push(`${name}.${key}`);
    }
  }
  return names;
}
