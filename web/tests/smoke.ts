// SPDX-License-Identifier: BSD-3-Clause
// The engine of a built explorer gives the event times of a scene of two layers, by their closed forms:  node smoke.mjs ENGINE SCENE
import { readFileSync } from "node:fs";
import { Engine } from "../src/engine/engine.ts";

const [engineFile, sceneFile] = process.argv.slice(2);
const engine = new Engine(new WebAssembly.Module(readFileSync(engineFile!)));
engine.setScene(readFileSync(sceneFile!, "utf8"));
const { t0, t1, tStar, interfaces } = engine.events("exact");
const [z0, zc, k0, k1] = [0.5, 0.29, 2.4, 0.31];
const expected = [(z0 - zc) / k1, (z0 - zc) / k1 + zc / k0, (1 - z0) / k1, 2 / k1];
const found = [interfaces[0]!.first, t0, t1, tStar];
const isRight = found.every((t, i) => Math.abs(t / expected[i]! - 1) < 1e-15 * 4);
console.log(isRight ? "event times agree with their closed forms" : `event times ${found.join(", ")} instead of ${expected.join(", ")}`);
process.exit(isRight ? 0 : 1);
