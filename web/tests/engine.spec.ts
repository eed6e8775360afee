// The engine in node: its answers are those of the program.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "@playwright/test";
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
