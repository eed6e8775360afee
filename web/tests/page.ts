// SPDX-License-Identifier: BSD-3-Clause
// What tests of the page share: it is served, opened, and must not complain.
import type { Server } from "node:http";
import { expect, type Page, test as base } from "@playwright/test";
import { PAGE } from "./places.ts";
import { serve } from "./server.ts";

/** What the page hangs on window, as far as tests ask. */
export interface Shown {
  t: number;
  toml: string;
  complaint: string;
  picture: { tMax: number; method: string; ms: number; events?: { t0: number; t1: number; tStar: number } };
}

interface Fixtures {
  url: string;
  explorer: Page;
}

export const test = base.extend<Fixtures, { served: { url: string; server: Server } }>({
  served: [
    async ({}, use) => {
      const served = await serve(PAGE);
      await use(served);
      served.server.close();
    },
    { scope: "worker" },
  ],
  url: async ({ served }, use) => use(served.url),
  explorer: async ({ page, url }, use) => {
    const errors: string[] = [];
    page.on("pageerror", (error) => errors.push(error.message));
    page.on("console", (message) => { if (message.type() === "error") errors.push(message.text()); });
    await open(page, url);
    await use(page);
    expect(errors).toEqual([]);
  },
});

export async function open(page: Page, url: string): Promise<void> {
  await page.goto(url);
  await page.waitForSelector("html[data-ready]");
}

export const shown = (page: Page): Promise<Shown> =>
  page.evaluate(() => {
    const app = (window as unknown as { shearfront: Shown }).shearfront;
    return { t: app.t, toml: app.toml, complaint: app.complaint, picture: { tMax: app.picture.tMax, method: app.picture.method, ms: app.picture.ms, events: app.picture.events } } as Shown;
  });

/** Texts of the table of event times, by name. */
export const eventTexts = (page: Page): Promise<Record<string, string>> =>
  page.$$eval("[data-event]", (cells) => Object.fromEntries(cells.map((c) => [c.getAttribute("data-event")!, c.textContent ?? ""])));

/** Drags a handle by pixels in steps; the times of the pictures on the way, in ms. */
export async function drag(page: Page, panel: string, handle: string, dx: number, dy: number, steps = 8): Promise<number[]> {
  const knob = page.locator(`#${panel} [data-handle="${handle}"] .knob`);
  const box = (await knob.boundingBox())!;
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  const times: number[] = [];
  for (let i = 1; i <= steps; ++i) {
    await page.mouse.move(x + (dx * i) / steps, y + (dy * i) / steps);
    times.push(Number(await page.locator("#plane").getAttribute("data-ms")));
  }
  await page.mouse.up();
  return times;
}

export { expect };
