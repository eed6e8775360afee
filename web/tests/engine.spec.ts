// SPDX-License-Identifier: BSD-3-Clause
// The engine in node: its answers are those of the program.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "@playwright/test";
import { FLUX_NAMES } from "../src/bed/edits.ts";
import { unknownOf } from "../src/bed/entries.ts";
import { CELLS, fineEnough } from "../src/bed/costs.ts";
import { COARSE, FINE, makePicture, type Picture } from "../src/bed/picture.ts";
import { shocksOf } from "../src/bed/shocks.ts";
import { readScene, type Scene } from "../src/bed/scene.ts";
import { mixingAt } from "../src/bed/why.ts";
import { Refusal } from "../src/engine/engine.ts";
import { stretches } from "../src/view/fit_charts.ts";
import { DATASETS, hasProgram, newEngine, program, sceneFiles } from "./places.ts";

interface EventsJson {
  t0: number | null;
  t1: number | null;
  t_star: number | null;
  mass: number;
  steady_height: number;
  interfaces: { z: number; first: number | null; last: number | null }[];
}

/** Of a chute x stands for t. */
const named = (text: string): EventsJson => JSON.parse(text.replace(/"x(\d|_star)"/g, '"t$1"')) as EventsJson;
const orNaN = (x: number | null): number => x ?? NaN;

for (const file of sceneFiles()) {
  test(`event times of ${file} are those of the program to the bit`, () => {
    test.skip(!hasProgram, "no program to compare with");
    const engine = newEngine();
    const path = join(DATASETS, file);
    const toml = readFileSync(path, "utf8");
    test.skip(/\bfile\s*=/.test(toml), "takes tables from other files");
    engine.setScene(toml);
    const refusal = engine.refusal("exact");
    const { status, out } = program("events", path, "--json");
    if (refusal) {
      expect(status).not.toBe(0);
      return;
    }
    expect(status).toBe(0);
    const expected = named(out);
    const events = engine.events("exact");
    const ours = [events.t0, events.t1, events.tStar, events.mass, events.steadyHeight, ...events.interfaces.flatMap((i) => [i.z, i.first, i.last])];
    const theirs = [expected.t0, expected.t1, expected.t_star, expected.mass, expected.steady_height, ...expected.interfaces.flatMap((i) => [i.z, i.first, i.last])].map(orNaN);
    expect(ours).toEqual(theirs);
  });
}

test("every scene of the data sets becomes a picture, or is refused in words", () => {
  test.setTimeout(300_000);
  const engine = newEngine();
  const refused: string[] = [];
  for (const file of sceneFiles()) {
    try {
      const picture = makePicture(engine, readFileSync(join(DATASETS, file), "utf8"), { ...COARSE, columns: 8, rows: 16, mixingPoints: 3 });
      expect(picture.tMax, file).toBeGreaterThan(0);
      expect(picture.raster.phi.every(Number.isFinite), file).toBe(true);
    } catch (error) {
      expect(error, file).toBeInstanceOf(Refusal);
      refused.push(file);
    }
  }
  // Slabs have no plane of t and z.
  expect(refused.filter((file) => !/slab/.test(file))).toEqual([]);
});

interface FitJson {
  parameters: { name: string; estimate: number; std_error: number | null }[];
  warnings: string[];
  misfit: number;
}

/** Of the data sets that come with the page. */
const FITS = ["paper-example-4/fit-bin-noise-0.01.toml", "paper-example-5/fit-bin-noise-0.01.toml", "segregation-gamma-0.9/fit.toml", "settling-column/fit.toml"];

for (const file of FITS) {
  test(`the fit ${file} finds what the program finds`, () => {
    test.skip(!hasProgram, "no program to compare with");
    const path = join(DATASETS, file);
    const expected = JSON.parse(program("fit", path, "--json").out) as FitJson;
    const toml = readFileSync(path, "utf8");
    const named = (key: string): string => readFileSync(join(path, "..", new RegExp(`^${key}\\s*=\\s*"([^"]+)"`, "m").exec(toml)![1]!), "utf8");
    const engine = newEngine();
    engine.setScene(named("scene"));
    engine.setObservations(named("observations"));
    const steps: number[] = [];
    const estimate = engine.fit(toml.replace(/^(scene|observations)\s*=.*$/gm, ""), (_, misfit) => steps.push(misfit) > 0);
    expect(estimate.status).toBe("ok");
    expect(estimate.misfit).toBeLessThan(expected.misfit * (1 + 1e-6));
    estimate.parameters.forEach((p, i) => {
      const theirs = expected.parameters[i]!;
      expect(p.name).toBe(theirs.name);
      // Of front tracking the misfit has steps; minima of both searches lie within a small part of an error bar.
      expect(Math.abs(p.estimate - theirs.estimate), p.name).toBeLessThan(0.05 * theirs.std_error!);
      expect(Math.abs(p.error / theirs.std_error! - 1), p.name).toBeLessThan(0.02);
    });
    expect(estimate.warnings).toEqual(expected.warnings);
    expect(steps.length).toBeGreaterThan(2);
  });
}

test("the search is drawn in stretches that only go down", () => {
  const course = [[1, 9], [2, 5], [3, 5], [4, 7], [5, 6], [6, 8]] as const;
  expect(stretches(course)).toEqual([[[1, 9], [2, 5], [3, 5]], [[4, 7], [5, 6]], [[6, 8]]]);
});

test("what an accuracy costs a grid: of a power law the law itself, beyond the grids too", () => {
  const trail = CELLS.map((n): [number, number] => [1e-5 * n ** 2, 3 / n]);
  for (const cells of [30, 170, 800, 5000]) {
    const found = fineEnough(trail, 3 / cells);
    expect(found.cells / cells).toBeCloseTo(1, 10);
    expect(found.ms / (1e-5 * cells ** 2)).toBeCloseTo(1, 10);
  }
});

test("the largest mixing lies where a parabola has its top, between the times computed", () => {
  const t = Array.from({ length: 11 }, (_, i) => i / 10);
  const psi = t.map((x) => 0.9 - (x - 0.437) ** 2);
  const found = mixingAt({ mixing: { t, psi } } as unknown as Picture, 0.25)!;
  expect(found.tMost).toBeCloseTo(0.437, 12);
  expect(found.psi).toBeCloseTo((psi[2]! + psi[3]!) / 2, 12);
});

test("shocks are there from the walls to t*, and no wave of a fan is one", () => {
  const engine = newEngine();
  for (const file of ["may-2010-piecewise/scene.toml", "may-2010-exponential/scene.toml"]) {
    const picture = makePicture(engine, readFileSync(join(DATASETS, file), "utf8"), FINE);
    const { t0, t1, tStar } = picture.events!;
    const shocks = shocksOf(picture);
    const at = (t: number): number => shocks.filter((f) => f.tBegin <= t && t < f.tEnd).length;
    for (let i = 1; i < 50; ++i) {
      // Of front tracking the first collision with a wall is late by part of a step.
      if (i < 48) expect(at((t0 * i) / 50), file).toBe(0);
      if (i > 5) expect(at(t0 + ((t1 - t0) * i) / 50), file).toBe(1);
      if (i > 5) expect(at(t1 + ((tStar - t1) * i) / 50), file).toBe(2);
    }
  }
  const bend = (file: string): number => makePicture(engine, readFileSync(join(DATASETS, file), "utf8"), COARSE).bend;
  expect([bend("traffic-red-light/scene.toml"), bend("segregation-gamma-0.9/scene.toml")]).toEqual([-1, 0]);
});

test("answers of the guided scenes hold", () => {
  const engine = newEngine();
  const open = (file: string): void => void engine.setScene(readFileSync(join(DATASETS, file), "utf8"));
  // Five layers: some 600 cells for front tracking with a step of 0.05, at the time that the scene opens with.
  open("paper-example-4/scene.toml");
  const error = (method: string): number => engine.pieces(method, 0.69, true).l1;
  const tracked = error("front-tracking resolution=0.05");
  expect(error("engquist-osher cells=500")).toBeGreaterThan(tracked);
  expect(error("engquist-osher cells=700")).toBeLessThan(tracked);
  // Best mixed one and a half times as late as t_1 = 0.5.
  open("shear-cell-ideal/scene-inverse.toml");
  const t = Array.from({ length: 41 }, (_, i) => 0.5 + 0.0125 * i);
  const psi = Array.from(engine.mixing("front-tracking resolution=0.005 reconstruct=linear", t));
  expect(t[psi.indexOf(Math.max(...psi))]! / 0.5).toBeCloseTo(1.5, 1);
});

test("a fit keeps what goes with the bed", () => {
  const scene = (rate: string): Scene => readScene(`[shear_rate]\n${rate}\n[initial]\nbreaks = [0.5]\nvalues = [0, 1]\n`);
  const three = scene("breaks = [0.3, 0.6]\nvalues = [3, 2, 1]");
  const two = scene("breaks = [0.3]\nvalues = [3, 2]");
  const whole = { parameters: ["shear_rate.values", "flux.gamma"], lower: [0, 0, 0, 0], upper: [9, 9, 9, 1], shape: "decreasing" };
  expect(unknownOf(three, whole)).toBe(whole);
  expect(unknownOf(two, whole)).toEqual({ parameters: whole.parameters });
  expect(unknownOf(two, { parameters: ["shear_rate.values[2]", "shear_rate.values[1]"] })).toEqual({ parameters: ["shear_rate.values[1]"] });
  expect(unknownOf(scene('model = "exponential"\namplitude = 3\ndecay = 0.2'), { parameters: ["shear_rate.values", "initial.breaks"] })).toEqual({ parameters: ["initial.breaks"] });
});

test("refusals are those of the program, word for word", () => {
  const engine = newEngine();
  const wrong = '[shear_rate]\nmodel = "exponentail"\n[initial]\nbreaks = [0.5, 0.4]\nvalues = [0, 1]\n';
  expect(() => engine.setScene(wrong)).toThrow(/scene.toml:2:9: shear_rate.model = "exponentail"; must be one of: piecewise/);
  expect(() => engine.setScene(wrong)).toThrow(/scene.toml:4:10: initial.breaks\[1\] = 0.4; must be greater than the break before it \(0.5\)/);
});

test("the page knows every flux of the library", () => {
  expect(FLUX_NAMES.toSorted()).toEqual(newEngine().fluxes().map((f) => f.name).toSorted());
});

test("numbers of an answer are written as the program writes them", () => {
  const engine = newEngine();
  const text = (x: number): string => {
    const scene = `[shear_rate]\nmodel = "piecewise"\nbreaks = []\nvalues = [1]\n[domain]\nbottom = -1e30\ntop = 1e30\n[initial]\nbreaks = [${x}, ${x}]\nvalues = [0, 1, 0]\n`;
    try {
      engine.setScene(scene);
      return "";
    } catch (error) {
      return /the break before it \((\S+)\)/.exec((error as Error).message)![1]!;
    }
  };
  for (const [x, written] of [[-1, "-1"], [-0.1, "-0.1"], [-1 / 3, "-0.3333333333333333"], [-1e-7, "-1e-07"], [-1e22, "-1e+22"], [-123456789, "-123456789"], [-2.5e-300, "-2.5e-300"]] as const)
    expect(text(x)).toBe(written);
});
