// SPDX-License-Identifier: BSD-3-Clause
// What goes in and out: links, files, the guided scenes, and nothing over the net.
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { DATASETS, hasProgram, PAGE, program } from "./places.ts";
import type { Page } from "@playwright/test";
import { drag, eventTexts, expect, open, shown, test } from "./page.ts";

test("guided scenes: each opens without a complaint, with three sentences and a question", async ({ explorer }) => {
  const ids = (await explorer.$$eval("#guided option", (options) => options.map((o) => (o as HTMLOptionElement).value))).filter(Boolean);
  expect(ids).toHaveLength(8);
  for (const id of ids) {
    await explorer.selectOption("#guided", id);
    expect((await shown(explorer)).complaint, id).toBe("");
    const text = (await explorer.locator("#guide-text").textContent())!;
    expect(text.split(/[.?!](?= |$)/).filter((s) => s.trim()).length, text).toBe(3);
    await expect(explorer.locator("#guide .question")).toContainText("?");
    await explorer.click("#guide summary");
  }
  await explorer.click("#guide-next");
  const told = (await shown(explorer)).toml;
  await expect(explorer.locator("#guide-again")).toBeHidden();
  await drag(explorer, "plane", "interface-0", 0, -20);
  await explorer.click("#guide-again");
  expect((await shown(explorer)).toml).toBe(told);
  await expect(explorer.locator("#guide-again")).toBeHidden();
  await expect(explorer.locator("#guide h2")).toContainText("1.");
  await explorer.click("#guide-before");
  await expect(explorer.locator("#guide h2")).toContainText("8.");
});

test("a link leads to the same scene, to the bit", async ({ explorer, context }) => {
  await drag(explorer, "plane", "interface-0", 0, -33);
  await explorer.click("#link");
  await expect(explorer.locator("#link")).not.toHaveText("copy link");
  const before = await shown(explorer);
  const other = await context.newPage();
  await open(other, explorer.url());
  expect((await shown(other)).toml).toBe(before.toml);
  expect(await eventTexts(other)).toEqual(await eventTexts(explorer));
  await other.close();
});

test("a broken link says so and shows the first scene", async ({ page, url }) => {
  await open(page, url + "#s=AAAA");
  await expect(page.locator("#complaint")).toContainText("cut off");
  expect((await shown(page)).picture.events!.tStar).toBeCloseTo(6.4516, 3);
});

test("files dropped: a scene, observations, and a scene that is none", async ({ explorer }) => {
  const dropText = (name: string, text: string): Promise<void> =>
    explorer.evaluate(([n, t]) => {
      const data = new DataTransfer();
      data.items.add(new File([t!], n!));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true }));
    }, [name, text]);
  await dropText("scene.toml", readFileSync(join(DATASETS, "bottleneck/scene.toml"), "utf8"));
  await expect.poll(async () => (await shown(explorer)).toml).toContain("Bottleneck");
  await dropText("my.csv", "t;z;phi;sigma\n0,5;0,25;0,1;0,01\n0,5;0,75;0,9;0,01\n1;0,5;0,6;0,01\n");
  await expect(explorer.locator("#data-about")).toContainText("3 observations (point)");
  await expect(explorer.locator("#panel-fit")).toBeVisible();
  await dropText("bad.csv", "t,z,phi\n0,7,0.5\n");
  await expect(explorer.locator("#data-about")).toContainText("must be inside the domain");
  await dropText("bad.toml", "[shear_rate]\nmodel = \"exponentail\"\n");
  await expect(explorer.locator("#complaint")).toContainText("exponentail");
});

/** Saves a file of the menu; its path. */
async function save(page: Page, name: string, folder: (name: string) => string): Promise<string> {
  await page.click("#save summary");
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(`#save-${name.replace(".", "-")}`)]);
  expect(download.suggestedFilename()).toBe(name);
  await download.saveAs(folder(name));
  return folder(name);
}

test("downloads: pictures, numbers, and a scene that the program runs to the same times", async ({ explorer }, info) => {
  const path = (name: string): string => info.outputPath(name);
  await drag(explorer, "plane", "interface-0", 0, -21);
  expect(readFileSync(await save(explorer, "plane.png", path)).subarray(1, 4).toString()).toBe("PNG");
  const picture = readFileSync(await save(explorer, "plane.svg", path), "utf8");
  expect(picture).toContain("<image");
  expect(picture).toContain("share of small grains: 0</text>");
  expect(picture).toContain("May et al. 2010");
  expect(readFileSync(await save(explorer, "solution.csv", path), "utf8")).toMatch(/^t,z,phi,M\n0,0,0,0\n/);
  const scene = await save(explorer, "scene.toml", path);
  if (!hasProgram) return;
  const expected = JSON.parse(program("events", scene, "--json").out) as { t0: number; t_star: number };
  const texts = await eventTexts(explorer);
  expect(Number(texts["t_0"])).toBe(expected.t0);
  expect(Number(texts["t*"])).toBe(expected.t_star);
});

test("a fit set up on the page is run by the program", async ({ explorer }, info) => {
  test.skip(!hasProgram, "no program to run it");
  await explorer.click("#tab-fit");
  await explorer.selectOption("#dataset", { index: 1 });
  await drag(explorer, "rate", "layer-0", 8, 0);
  for (const name of ["scene.toml", "observations.csv", "fit.toml"]) await save(explorer, name, (n) => info.outputPath(n));
  const { out, err, status } = program("fit", info.outputPath("fit.toml"), "--json");
  expect(status, err).toBe(0);
  const { parameters } = JSON.parse(out) as { parameters: { estimate: number }[] };
  [3.314, 2.312, 1.629, 1.05, 0.5302].forEach((value, i) => expect(parameters[i]!.estimate).toBeCloseTo(value, 2));
});

test("scene, observations and fit are opened again, all three at once", async ({ explorer }, info) => {
  await explorer.click("#tab-fit");
  await explorer.selectOption("#dataset", { index: 3 });
  await explorer.locator("#unknowns input").first().click();
  const before = await shown(explorer);
  const unknowns = (): Promise<string[]> => explorer.$$eval("#unknowns input:checked", (boxes) => boxes.map((b) => (b as HTMLInputElement).value));
  const chosen = await unknowns();
  expect(chosen.length).toBeGreaterThan(1);
  const files: string[] = [];
  for (const name of ["fit.toml", "observations.csv", "scene.toml"]) files.push(await save(explorer, name, (n) => info.outputPath(n)));
  await explorer.selectOption("#guided", "may");
  await explorer.locator("#open-file").setInputFiles(files);
  await expect(explorer.locator("#data-about")).toContainText("400 observations (bin)");
  expect((await shown(explorer)).toml).toBe(before.toml);
  expect(await unknowns()).toEqual(chosen);
  await expect(explorer.locator("#complaint")).toBeHidden();
});

test("a fit leaves nothing behind in the next scene, and outlives a layer", async ({ explorer }) => {
  await explorer.selectOption("#guided", "particles");
  await explorer.click("#tab-bed");
  await explorer.click("#remove-layer-4");
  await explorer.click("#tab-fit");
  await expect(explorer.locator("#fit-state")).toHaveText(""); // bounds of five rates are no bounds of four
  expect(Number(await explorer.locator("#panel-fit > div").getAttribute("data-rms"))).toBeGreaterThan(0);
  await explorer.selectOption("#guided", "may");
  await explorer.click("#tab-fit");
  await expect(explorer.locator("#data-about")).toHaveText("");
  await expect(explorer.locator("#dataset")).toHaveValue("");
  await expect(explorer.locator("#run-fit")).toBeDisabled();
  await explorer.click("#undo");
  await expect(explorer.locator("#fit-state")).toHaveText("");
});

test("a fit in the worker: estimates, intervals, ellipse, and undo back to the start", async ({ explorer }, info) => {
  await explorer.click("#tab-fit");
  await explorer.selectOption("#dataset", { index: 1 });
  await expect(explorer.locator("#data-about")).toContainText("1980 observations (bin)");
  const start = await shown(explorer);
  const rms = Number(await explorer.locator("#panel-fit > div").getAttribute("data-rms"));
  await explorer.click("#run-fit");
  await explorer.waitForSelector('[data-status="ok"]', { timeout: 50_000 });
  await expect(explorer.locator("#estimates tbody tr")).toHaveCount(5);
  const estimates = await explorer.$$eval("#estimates tbody tr td:nth-child(3)", (cells) => cells.map((c) => Number(c.textContent)));
  [3.314, 2.312, 1.629, 1.05, 0.5302].forEach((value, i) => expect(estimates[i]).toBeCloseTo(value, 2));
  expect(Number(await explorer.locator("#panel-fit > div").getAttribute("data-rms"))).toBeLessThan(rms);
  const third = explorer.locator("#estimates tbody tr", { hasText: "rate of layer 3" });
  await expect(third).toContainText("shear_rate.values[2]");
  await expect(third).toContainText(/1\.627 to 1\.631 \(± 0\.1\d %\)/);
  await expect(explorer.locator("#how-sure")).toContainText("Known best: rate of layer 5");
  await expect(explorer.locator(".curve.ellipse path")).toHaveAttribute("d", /M/);
  await explorer.selectOption("#ellipse-b", { index: 3 });
  await explorer.screenshot({ path: info.outputPath("fit.png"), fullPage: true });
  await explorer.click("#undo");
  expect((await shown(explorer)).toml).toBe(start.toml);
});

test("a fit can be stopped, unknowns chosen", async ({ explorer }) => {
  await explorer.click("#tab-fit");
  await explorer.selectOption("#dataset", { index: 3 });
  await explorer.evaluate(() => {
    for (const id of ["run-fit", "stop-fit"]) document.getElementById(id)!.click(); // at once: fits take a moment only
  });
  await expect(explorer.locator("#fit-state")).toContainText("stopped");
  await explorer.locator("#unknowns input").last().click();
  await expect(explorer.locator("#run-fit")).toBeEnabled();
});

test("nothing is asked of the net, and the page works without it", async ({ page, url, context }) => {
  const requests: string[] = [];
  page.on("request", (request) => requests.push(request.url()));
  await open(page, url);
  await context.setOffline(true);
  await page.selectOption("#guided", "exponential");
  await page.click("#tab-methods");
  await expect(page.locator("#error-tracked")).toContainText("e-");
  await page.click("#tab-fit");
  await page.selectOption("#dataset", { index: 2 });
  await page.click("#run-fit");
  await page.waitForSelector('[data-status="ok"]', { timeout: 50_000 });
  expect(requests.filter((r) => !r.startsWith(url) && !r.startsWith("blob:") && !r.startsWith("data:"))).toEqual([]);
  expect(requests.filter((r) => r.startsWith(url)).length).toBeLessThanOrEqual(3);
});

test("it opens from a file", async ({ page }) => {
  await open(page, pathToFileURL(join(PAGE, "index.html")).href);
  expect((await shown(page)).picture.events!.t1).toBe(1.6129032258064517);
  await page.click("#tab-fit");
  await page.selectOption("#dataset", { index: 2 });
  await page.click("#run-fit");
  await page.waitForSelector('[data-status="ok"]', { timeout: 50_000 });
});

test("400 px wide: nothing sticks out, and a finger drags", async ({ browser, url }, info) => {
  const context = await browser.newContext({ viewport: { width: 400, height: 800 }, hasTouch: true, isMobile: true });
  const page = await context.newPage();
  await open(page, url);
  for (const tab of ["bed", "methods", "collisions", "fit"]) {
    await page.click(`#tab-${tab}`);
    await page.waitForTimeout(400);
    expect(await page.evaluate(() => document.documentElement.scrollWidth), tab).toBeLessThanOrEqual(400);
    await page.screenshot({ path: info.outputPath(`400-${tab}.png`), fullPage: true });
  }
  await page.evaluate(() => window.scrollTo(0, 0));
  await page.tap('#plane [data-event-mark="t_1"] circle');
  await expect(page.locator("#why-t_1")).toBeInViewport();
  const before = await shown(page);
  expect(before.t).toBe(1.6129032258064517);
  await page.locator("#plane").scrollIntoViewIfNeeded();
  const box = (await page.locator('#plane [data-handle="interface-0"] .knob').boundingBox())!;
  const client = await context.newCDPSession(page);
  const touch = (type: "touchStart" | "touchMove" | "touchEnd", dy: number): Promise<unknown> =>
    client.send("Input.dispatchTouchEvent", { type, touchPoints: type === "touchEnd" ? [] : [{ x: box.x + 14, y: box.y + 6 + dy }] });
  await touch("touchStart", 0);
  for (let i = 1; i <= 5; ++i) await touch("touchMove", -6 * i);
  await touch("touchEnd", 0);
  expect((await shown(page)).toml).not.toBe(before.toml);
  await context.close();
});

test("how long a picture takes while it is dragged", async ({ explorer }, info) => {
  const below = (share: number, xs: number[]): number => xs.toSorted((a, b) => a - b)[Math.floor(share * (xs.length - 1))]!;
  const median = (xs: number[]): number => below(0.5, xs);
  await drag(explorer, "plane", "interface-0", 0, -20, 10);
  const one = await drag(explorer, "plane", "interface-0", 0, 30, 30);
  const ten = "[shear_rate]\nmodel = \"piecewise\"\nbreaks = [0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9]\nvalues = [3,2.5,2.1,1.7,1.4,1.1,0.9,0.7,0.5,0.4]\n" +
    "[initial]\nbreaks = [0.063,0.163,0.263,0.363,0.463,0.563,0.663,0.763,0.863,0.963]\nvalues = [0.1,0.9,0.1,0.9,0.1,0.9,0.1,0.9,0.1,0.9,0.1]\n";
  await explorer.locator("#open-file").setInputFiles({ name: "ten.toml", mimeType: "text/plain", buffer: Buffer.from(ten) });
  await expect(explorer.locator('[data-event^="t_c"]')).toHaveCount(9);
  const many = await drag(explorer, "plane", "interface-4", 0, -16, 30);
  const times = { ready: Number(await explorer.getAttribute("html", "data-ready")), example1: median(one), example1_nine_of_ten: below(0.9, one), ten: median(many), ten_nine_of_ten: below(0.9, many) };
  writeFileSync(info.outputPath("times.json"), JSON.stringify(times));
  console.log(JSON.stringify(times));
  expect((await shown(explorer)).complaint).toBe("");
  // The machine may be busy: these are far above what is aimed at, 16 and 50 ms.
  expect(times.example1).toBeLessThan(200);
  expect(times.ten).toBeLessThan(600);
});
