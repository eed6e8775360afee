// SPDX-License-Identifier: BSD-3-Clause
// Bundles the page with all it needs: the engine, the formulas (made by KaTeX at build time), scenes and data of datasets/.
// Nothing is fetched, so the page also opens from a file.
import { readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import katex from "katex";
import { defineConfig, type Plugin } from "vite";
import datasets from "./datasets.json" with { type: "json" };

const out = process.env["SHEARFRONT_WEB_OUT"] ?? "../build/web/page";
const engine = process.env["SHEARFRONT_WEB_ENGINE"] ?? "../build/web/web/engine.wasm";

function made(name: string, make: () => string): Plugin {
  return {
    name: `shearfront-${name}`,
    resolveId: (id) => (id === `virtual:${name}` ? `\0virtual:${name}` : undefined),
    load: (id) => (id === `\0virtual:${name}` ? make() : undefined),
  };
}

const exported = (value: unknown): string => `export default ${JSON.stringify(value)};`;

function formulas(): string {
  const sources = JSON.parse(readFileSync("formulas.json", "utf8")) as Record<string, string>;
  const render = (tex: string): string =>
    katex.renderToString(tex, { output: "mathml", throwOnError: true }).replace(/<annotation.*?<\/annotation>/s, "");
  return exported(Object.fromEntries(Object.entries(sources).map(([name, tex]) => [name, render(tex)])));
}

/** Comments of data files are not needed twice: what made them stands in datasets/. */
const withoutComments = (text: string): string => text.replace(/^#.*\n/gm, "");

/** Scripts that are no modules run from file:// too. */
const classic: Plugin = {
  name: "shearfront-classic",
  enforce: "post",
  transformIndexHtml: (html) => html.replace(/<script type="module" crossorigin/g, "<script defer").replace(/<link rel="stylesheet" crossorigin/g, '<link rel="stylesheet"'),
};

export default defineConfig({
  base: "./",
  plugins: [
    made("engine", () => exported(gzipSync(readFileSync(engine), { level: 9 }).toString("base64"))),
    made("formulas", formulas),
    made("datasets", () =>
      exported(Object.fromEntries(datasets.map((file) => [file, withoutComments(readFileSync(`../datasets/${file}`, "utf8"))]))),
    ),
    classic,
  ],
  worker: { format: "iife" },
  build: {
    outDir: out,
    emptyOutDir: true,
    target: "es2022",
    modulePreload: false,
    chunkSizeWarningLimit: 4000,
    rollupOptions: { output: { format: "iife", inlineDynamicImports: true, entryFileNames: "explorer.js", assetFileNames: "explorer.[ext]" } },
  },
});
