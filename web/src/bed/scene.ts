// SPDX-License-Identifier: BSD-3-Clause
// The scene as its file says it: a tree of TOML tables, never changed in place. What the page does not know it keeps.
import { parse, stringify } from "smol-toml";

export type Value = string | number | boolean | Value[] | Table;
export interface Table {
  [key: string]: Value;
}
export type Scene = Table;

export function readScene(toml: string): Scene {
  return parse(toml) as Scene;
}

export function writeScene(scene: Scene): string {
  return stringify(scene) + "\n";
}

export function table(scene: Scene, key: string): Table {
  const value = scene[key];
  return typeof value === "object" && !Array.isArray(value) ? value : {};
}

export function numbers(of: Table, key: string): number[] {
  const value = of[key];
  return Array.isArray(value) ? value.map(Number) : [];
}

export function number(of: Table, key: string, otherwise: number): number {
  const value = of[key];
  return value === undefined ? otherwise : Number(value);
}

export const bottomOf = (scene: Scene): number => number(table(scene, "domain"), "bottom", 0);
export const topOf = (scene: Scene): number => number(table(scene, "domain"), "top", 1);
export const rateModel = (scene: Scene): string => String(table(scene, "shear_rate")["model"] ?? "piecewise");
export const scaleOf = (scene: Scene): number => number(table(scene, "shear_rate"), "scale", 1);
export const unitsOf = (scene: Scene): { z: string; t: string } => {
  const units = table(scene, "units");
  return { z: String(units["z"] ?? ""), t: String(units["t"] ?? "") };
};

/** Fluxes of layers from the bottom up: one, or an array of tables. */
export function fluxOf(scene: Scene): Table {
  const flux = scene["flux"];
  if (Array.isArray(flux)) return (flux[0] as Table) ?? {};
  return (flux as Table) ?? { model: "quadratic" };
}
export const hasManyFluxes = (scene: Scene): boolean => Array.isArray(scene["flux"]) && scene["flux"].length > 1;

/** Whether the start is constant in pieces, and so can be dragged. */
export const hasSteps = (scene: Scene): boolean => Array.isArray(table(scene, "initial")["values"]) && table(scene, "initial")["model"] === undefined;

/** A copy with a table changed. */
export function withTable(scene: Scene, key: string, change: Table): Scene {
  return { ...scene, [key]: { ...table(scene, key), ...change } };
}

export function without(scene: Scene, key: string): Scene {
  const { [key]: _, ...rest } = scene;
  return rest;
}
