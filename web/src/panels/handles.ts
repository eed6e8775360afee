// SPDX-License-Identifier: BSD-3-Clause
// Which handles each panel has, and what dragging them does to the scene.
import * as edit from "../bed/edits.ts";
import type { Picture } from "../bed/picture.ts";
import { bottomOf, hasSteps, number, numbers, rateModel, type Scene, scaleOf, table, topOf } from "../bed/scene.ts";
import { brief } from "../view/numbers.ts";
import type { Handle } from "../view/panel.ts";

export interface Bed {
  scene: Scene;
  picture: Picture;
  change(scene: Scene): void;
}

function interfaces(bed: Bed, x: (i: number) => number): Handle[] {
  const { scene } = bed;
  if (rateModel(scene) !== "piecewise") return [];
  const height = topOf(scene) - bottomOf(scene);
  return numbers(table(scene, "shear_rate"), "breaks").map((z, i) => ({
    id: `interface-${i}`, label: `Interface ${i + 1} of a(z)`, text: `z = ${brief(z)}`, value: z, x: x(i), y: z, direction: "y",
    drag: (_, to) => bed.change(edit.moveInterface(bed.scene, i, to)),
    step: (by) => bed.change(edit.moveInterface(bed.scene, i, z + by * height)),
  }));
}

function jumps(bed: Bed, x: (i: number) => number): Handle[] {
  const { scene } = bed;
  if (!hasSteps(scene)) return [];
  const height = topOf(scene) - bottomOf(scene);
  return numbers(table(scene, "initial"), "breaks").map((z, i) => ({
    id: `jump-${i}`, label: `Jump ${i + 1} of the start`, text: `z = ${brief(z)}`, value: z, x: x(i), y: z, direction: "y",
    drag: (_, to) => bed.change(edit.moveJump(bed.scene, i, to)),
    step: (by) => bed.change(edit.moveJump(bed.scene, i, z + by * height)),
  }));
}

/** Solids of the bed at a height: states of the start are shares of them. */
function solidAt(picture: Picture, z: number): number {
  const { z: heights, solid } = picture.rate;
  const after = heights.findIndex((height) => height >= z);
  if (after <= 0) return solid[Math.max(0, after)] ?? 1;
  const [low, high] = [heights[after - 1]!, heights[after]!];
  return solid[after - 1]! + ((z - low) / (high - low || 1)) * (solid[after]! - solid[after - 1]!);
}

export function planeHandles(bed: Bed): Handle[] {
  const { tMax } = bed.picture;
  return [...jumps(bed, () => 0), ...interfaces(bed, () => tMax)];
}

export function profileHandles(bed: Bed): Handle[] {
  const { scene, picture } = bed;
  if (!hasSteps(scene)) return [];
  const { lowest, highest } = picture.facts;
  const start = table(scene, "initial");
  const breaks = numbers(start, "breaks");
  const values = numbers(start, "values");
  const edges = [bottomOf(scene), ...breaks, topOf(scene)];
  const states: Handle[] = values.map((phi, i) => {
    const y = (edges[i]! + edges[i + 1]!) / 2;
    const solid = solidAt(picture, y);
    return {
      id: `state-${i}`, label: `Start, piece ${i + 1} from the bottom`, text: `phi = ${brief(phi)}`, value: phi, x: phi * solid, y, direction: "x",
      drag: (to) => bed.change(edit.setState(bed.scene, i, to / solid, lowest, highest)),
      step: (by) => bed.change(edit.setState(bed.scene, i, phi + by * (highest - lowest), lowest, highest)),
    };
  });
  return [...states, ...jumps(bed, (i) => ((values[i]! + values[i + 1]!) / 2) * solidAt(picture, breaks[i]!))];
}

export function rateHandles(bed: Bed, widest: number): Handle[] {
  const { scene } = bed;
  const rate = table(scene, "shear_rate");
  const scale = scaleOf(scene);
  const bottom = bottomOf(scene);
  const top = topOf(scene);
  const limit = (speed: number): number => Math.min(widest, Math.max(widest * 1e-3, speed));
  if (rateModel(scene) === "piecewise") {
    const edges = [bottom, ...numbers(rate, "breaks"), top];
    const values = numbers(rate, "values");
    const speeds: Handle[] = values.map((a, i) => ({
      id: `layer-${i}`, label: `Rate of layer ${i + 1} from the bottom`, text: `s a = ${brief(a * scale)}`, value: a * scale,
      x: a * scale, y: (edges[i]! + edges[i + 1]!) / 2, direction: "x",
      drag: (to) => bed.change(edit.setLayerSpeed(bed.scene, i, limit(to))),
      step: (by) => bed.change(edit.setLayerSpeed(bed.scene, i, limit(a * scale + by * widest))),
    }));
    return [...speeds, ...interfaces(bed, (i) => ((values[i]! + values[i + 1]!) / 2) * scale)];
  }
  if (rateModel(scene) === "table") {
    const values = numbers(rate, "values");
    return numbers(rate, "z").map((z, i) => ({
      id: `point-${i}`, label: `Rate at z = ${brief(z)}`, text: `s a = ${brief(values[i]! * scale)}`, value: values[i]! * scale,
      x: values[i]! * scale, y: Math.min(top, Math.max(bottom, z)), direction: "x",
      drag: (to) => bed.change(edit.movePoint(bed.scene, i, limit(to))),
      step: (by) => bed.change(edit.movePoint(bed.scene, i, limit(values[i]! * scale + by * widest))),
    }));
  }
  if (rateModel(scene) === "exponential") {
    const amplitude = number(rate, "amplitude", 1);
    const decay = number(rate, "decay", 1);
    const speed = (z: number): number => amplitude * Math.exp(-z / decay) * scale;
    const handle = (id: string, label: string, z: number, keeps: "decay" | "amplitude", text: string): Handle => ({
      id, label, text, value: speed(z), x: speed(z), y: z, direction: "x",
      drag: (to) => bed.change(edit.bendExponential(bed.scene, z, limit(to), keeps)),
      step: (by) => bed.change(edit.bendExponential(bed.scene, z, limit(speed(z) + by * widest), keeps)),
    });
    const low = bottom + 0.06 * (top - bottom);
    const middle = bottom + 0.5 * (top - bottom);
    return [
      handle("amplitude", "Size of the exponential rate", low, "decay", `amplitude ${brief(amplitude)}`),
      handle("decay", "Bend of the exponential rate", middle, "amplitude", `decay ${brief(decay)}`),
    ];
  }
  return [];
}
