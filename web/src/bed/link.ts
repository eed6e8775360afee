// SPDX-License-Identifier: BSD-3-Clause
// A scene in an address: its file, deflated, in the letters that addresses allow.

async function through(bytes: Uint8Array<ArrayBuffer>, transform: CompressionStream | DecompressionStream): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([bytes]).stream().pipeThrough(transform);
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function toLetters(bytes: Uint8Array): string {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

export function fromLetters(letters: string): Uint8Array<ArrayBuffer> {
  const text = atob(letters.replaceAll("-", "+").replaceAll("_", "/"));
  return Uint8Array.from(text, (c) => c.charCodeAt(0));
}

export async function toHash(toml: string): Promise<string> {
  return "#s=" + toLetters(await through(new TextEncoder().encode(toml), new CompressionStream("deflate-raw")));
}

/** The scene file in an address, or nothing if it holds none that can be read. */
export async function fromHash(hash: string): Promise<string | undefined> {
  if (!hash.startsWith("#s=")) return undefined;
  try {
    return new TextDecoder().decode(await through(fromLetters(hash.slice(3)), new DecompressionStream("deflate-raw")));
  } catch {
    return undefined;
  }
}

export async function gunzip(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  return through(bytes, new DecompressionStream("gzip"));
}
