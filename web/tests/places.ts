// SPDX-License-Identifier: BSD-3-Clause
// Where things are: the built page and engine, the program, the data sets.
import { execFileSync } from "node:child_process";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { Engine } from "../src/engine/engine.ts";

export const ROOT = resolve(import.meta.dirname, "../..");
export const DATASETS = join(ROOT, "datasets");
export const PAGE = process.env["SHEARFRONT_WEB_OUT"] ?? join(ROOT, "build/web/page");
const ENGINE = process.env["SHEARFRONT_WEB_ENGINE"] ?? join(ROOT, "build/web/web/engine.wasm");

/** The program to compare with. */
export const PROGRAM = process.env["SHEARFRONT_PROGRAM"] ?? join(ROOT, "build/release/tools/shearfront");
export const hasProgram = existsSync(PROGRAM);

let kept: WebAssembly.Module | undefined;
export function newEngine(): Engine {
  kept ??= new WebAssembly.Module(readFileSync(ENGINE));
  return new Engine(kept);
}

export function program(...args: string[]): { status: number; out: string; err: string } {
  try {
    return { status: 0, out: execFileSync(PROGRAM, args, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"], maxBuffer: 1e8 }), err: "" };
  } catch (error) {
    const failed = error as { status: number; stdout: string; stderr: string };
    return { status: failed.status, out: failed.stdout, err: failed.stderr };
  }
}

/** Every scene of the data sets. */
export function sceneFiles(): string[] {
  return readdirSync(DATASETS)
    .flatMap((name) => readdirSync(join(DATASETS, name)).filter((file) => /^(scene|truth).*\.toml$/.test(file)).map((file) => join(name, file)))
    .sort();
}
