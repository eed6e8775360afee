// SPDX-License-Identifier: BSD-3-Clause
// Made by vite.config.ts.
declare module "virtual:engine" {
  /** engine.wasm, gzipped, in base64 */
  const letters: string;
  export default letters;
}
declare module "virtual:formulas" {
  /** MathML of formulas.json */
  const formulas: Record<string, string>;
  export default formulas;
}
declare module "virtual:datasets" {
  /** Text of files below datasets/ */
  const files: Record<string, string>;
  export default files;
}
declare module "*?worker&inline" {
  const Constructor: new () => Worker;
  export default Constructor;
}
declare module "*.css";
