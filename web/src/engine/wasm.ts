// SPDX-License-Identifier: BSD-3-Clause
// The file of WebAssembly: its start, its memory, and calls that answer numbers and a text.

export type Watch = (evaluations: number, misfit: number, values: Float64Array) => boolean;

interface Exports {
  memory: WebAssembly.Memory;
  _initialize?: () => void;
  sf_allocate(bytes: number): number;
  sf_free(address: number): void;
  sf_numbers(): number;
  sf_n_numbers(): number;
  sf_text(): number;
  sf_n_text(): number;
}

/** What the engine answered: views of `numbers` are copies, safe to keep. */
export interface Answer {
  numbers: Float64Array;
  text: string;
}

/** A refusal of the engine: bad input, or a method that does not solve the bed. Its message is the engine's. */
export class Refusal extends Error {}

const NOT_SUPPORTED = 52; // of WASI

export class Wasm {
  private readonly exports: Exports & Record<string, (...args: number[]) => number>;
  private readonly encoder = new TextEncoder();
  private readonly decoder = new TextDecoder();
  watch: Watch = () => true;

  constructor(module: WebAssembly.Module) {
    const known: Record<string, (...args: number[]) => unknown> = {
      sf_watch: (evaluations, misfit, address, n) =>
        this.watch(evaluations!, misfit!, new Float64Array(this.memory, address, n).slice()) ? 1 : 0,
      clock_time_get: (_clock, _precision, address) => {
        new DataView(this.memory).setBigUint64(address!, BigInt(Math.round(performance.now() * 1e6)), true);
        return 0;
      },
      environ_sizes_get: (count, size) => {
        new DataView(this.memory).setUint32(count!, 0, true);
        new DataView(this.memory).setUint32(size!, 0, true);
        return 0;
      },
      environ_get: () => 0,
      fd_write: (_fd, vectors, n, written) => {
        const view = new DataView(this.memory);
        let size = 0;
        for (let i = 0; i < n!; ++i) size += view.getUint32(vectors! + 8 * i + 4, true);
        view.setUint32(written!, size, true);
        return 0;
      },
      emscripten_notify_memory_growth: () => undefined,
      proc_exit: (code) => {
        throw new Error(`the engine stopped with code ${code}`);
      },
    };
    const imports: Record<string, Record<string, (...args: number[]) => unknown>> = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module))
      (imports[from] ??= {})[name] = known[name] ?? (() => NOT_SUPPORTED);
    const instance = new WebAssembly.Instance(module, imports as WebAssembly.Imports);
    this.exports = instance.exports as unknown as Wasm["exports"];
    this.exports._initialize?.();
  }

  private get memory(): ArrayBuffer {
    return this.exports.memory.buffer;
  }

  /** Calls a function; texts and arrays are handed over as address and size. Throws Refusal. */
  call(name: string, ...args: (string | number | Float64Array)[]): Answer {
    const taken: number[] = [];
    const flat: number[] = [];
    for (const arg of args) {
      if (typeof arg === "number") {
        flat.push(arg);
        continue;
      }
      const bytes = typeof arg === "string" ? this.encoder.encode(arg) : new Uint8Array(arg.buffer, arg.byteOffset, arg.byteLength);
      const address = this.exports.sf_allocate(Math.max(8, bytes.length));
      new Uint8Array(this.memory).set(bytes, address);
      taken.push(address);
      flat.push(address, typeof arg === "string" ? bytes.length : arg.length);
    }
    const done = this.exports[name]!(...flat);
    for (const address of taken) this.exports.sf_free(address);
    const text = this.decoder.decode(new Uint8Array(this.memory, this.exports.sf_text(), this.exports.sf_n_text()));
    if (!done) throw new Refusal(text);
    const numbers = new Float64Array(this.memory, this.exports.sf_numbers(), this.exports.sf_n_numbers()).slice();
    return { numbers, text };
  }
}
