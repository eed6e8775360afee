// SPDX-License-Identifier: BSD-3-Clause
// Numbers as texts.
import { format } from "d3-format";

const short = format(".4~g");
export const brief = (x: number): string => (Number.isFinite(x) ? short(x).replace("−", "-") : "never");
/** All digits: reads back to the same number. As the program prints it. */
export const full = (x: number): string => (Number.isFinite(x) ? String(x) : "never");
export const withUnit = (text: string, unit: string): string => (unit ? `${text} ${unit}` : text);
export const milliseconds = (ms: number): string => (ms < 0.1 ? ms.toPrecision(1) : ms < 10 ? ms.toFixed(1) : ms.toFixed(0)) + " ms";
