// SPDX-License-Identifier: BSD-3-Clause
// phi as a colour: viridis, which stays in order for colour-blind eyes and in print without colours.
import { interpolateViridis } from "d3-scale-chromatic";

const N = 256;
/** RGBA of viridis as 32-bit words of little-endian memory. */
const WORDS = Uint32Array.from({ length: N }, (_, i) => {
  const [r, g, b] = rgb(interpolateViridis(i / (N - 1)));
  return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
});

function rgb(text: string): [number, number, number] {
  if (text.startsWith("#")) return [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16)) as [number, number, number];
  return text.match(/\d+/g)!.slice(0, 3).map(Number) as [number, number, number];
}

export const css = (share: number): string => interpolateViridis(Math.min(1, Math.max(0, share)));

/** Pixels of phi[column * rows + row], rows from the bottom up, columns from left to right. */
export function paint(phi: Float64Array, columns: number, rows: number, low: number, high: number): ImageData {
  const image = new ImageData(columns, rows);
  const words = new Uint32Array(image.data.buffer);
  const scale = (N - 1) / (high - low || 1);
  for (let i = 0; i < columns; ++i)
    for (let j = 0; j < rows; ++j) {
      const k = (phi[i * rows + j]! - low) * scale;
      words[(rows - 1 - j) * columns + i] = WORDS[k <= 0 ? 0 : k >= N - 1 ? N - 1 : Math.round(k)]!;
    }
  return image;
}
