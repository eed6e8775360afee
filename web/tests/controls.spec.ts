// SPDX-License-Identifier: BSD-3-Clause
// Every control does what it says.
import { drag, eventTexts, expect, shown, test } from "./page.ts";

test("the first picture is Example 1, with its event times", async ({ explorer }) => {
  expect(await eventTexts(explorer)).toEqual({
    t_c: "0.6774193548387097", t_0: "0.7982526881720431", t_1: "1.6129032258064517", "t^_c": "5.005088098665776", "t*": "6.451612903225807",
  });
  expect(Number(await explorer.getAttribute("html", "data-ready"))).toBeLessThan(10_000);
});

test("interfaces, jumps, rates and states are dragged in all panels", async ({ explorer }) => {
  const before = await shown(explorer);
  await drag(explorer, "plane", "interface-0", 0, -40);
  const moved = await shown(explorer);
  expect(moved.toml).not.toBe(before.toml);
  expect(moved.picture.events!.t1).toBe(before.picture.events!.t1);
  expect(moved.picture.events!.t0).toBeLessThan(before.picture.events!.t0);
  await explorer.click("#undo");
  expect((await shown(explorer)).toml).toBe(before.toml); // a drag is one step
  await drag(explorer, "rate", "layer-1", 30, 0);
  expect((await shown(explorer)).picture.events!.tStar).toBeLessThan(before.picture.events!.tStar);
  await explorer.click("#undo");
  await drag(explorer, "plane", "jump-0", 0, -30);
  expect((await shown(explorer)).picture.events!.t1).toBeLessThan(before.picture.events!.t1);
  await explorer.click("#undo");
  await drag(explorer, "profile", "state-0", 40, 0);
  expect((await shown(explorer)).picture.events!.t0).toBe(0); // mixed grains at a wall move at once
  await explorer.click("#undo");
  await explorer.click("#redo");
  await explorer.click("#undo");
  await drag(explorer, "rate", "interface-0", 0, -20);
  await drag(explorer, "profile", "jump-0", 0, 20);
  expect((await shown(explorer)).complaint).toBe("");
});

test("keys move handles, undo and redo", async ({ explorer }) => {
  const before = await shown(explorer);
  await explorer.locator('#plane [data-handle="interface-0"]').focus();
  await explorer.keyboard.press("ArrowUp");
  expect((await shown(explorer)).toml).toContain("0.3");
  await explorer.keyboard.press("PageUp");
  expect(await explorer.evaluate(() => document.activeElement?.getAttribute("data-handle"))).toBe("interface-0");
  await explorer.keyboard.press("Control+z");
  await explorer.keyboard.press("Control+z");
  expect((await shown(explorer)).toml).toBe(before.toml);
  await explorer.keyboard.press("Control+Shift+z");
  expect((await shown(explorer)).toml).not.toBe(before.toml);
  await explorer.keyboard.press("Control+z");
  await explorer.locator("#tab-bed").focus();
  await explorer.keyboard.press("ArrowRight");
  await expect(explorer.locator("#panel-methods")).toBeVisible();
});

test("time: pointer, slider, a click on an event, the end of the axis, fronts on and off", async ({ explorer }) => {
  const box = (await explorer.locator("#plane svg").boundingBox())!;
  await explorer.mouse.move(box.x + box.width / 2, box.y + box.height / 3);
  const { t, picture } = await shown(explorer);
  expect(t).toBeGreaterThan(0.3 * picture.tMax);
  await expect(explorer.locator("#profile figcaption")).toContainText("t = ");
  await explorer.locator('[data-event="t_1"] button').click();
  expect((await shown(explorer)).t).toBeCloseTo(1.6129032258064517, 12);
  await explorer.locator("#time").fill("500");
  expect((await shown(explorer)).t).toBeCloseTo(picture.tMax / 2, 6);
  await explorer.fill("#time-end", "3");
  await explorer.press("#time-end", "Enter");
  expect((await shown(explorer)).picture.tMax).toBe(3);
  await explorer.fill("#time-end", "");
  await explorer.press("#time-end", "Enter");
  expect((await shown(explorer)).picture.tMax).toBe(picture.tMax);
  await explorer.uncheck("#fronts");
  await explorer.check("#fronts");
});

test("layers and jumps are added, numbered, changed and removed", async ({ explorer }) => {
  await explorer.click("#add-layer");
  await explorer.click("#add-layer");
  await expect(explorer.locator('[data-event^="t_c"]')).toHaveCount(3);
  await explorer.fill("#rate-1", "0.5");
  await explorer.press("#rate-1", "Enter");
  await explorer.fill("#break-0", "0.2");
  await explorer.press("#break-0", "Enter");
  expect((await shown(explorer)).toml).toContain("0.2");
  await explorer.click("#remove-layer-0");
  await expect(explorer.locator('[data-event^="t_c"]')).toHaveCount(2);
  await explorer.click("#add-jump");
  await explorer.fill("#start-0", "0.25");
  await explorer.press("#start-0", "Enter");
  await explorer.fill("#start-break-0", "0.2");
  await explorer.press("#start-break-0", "Enter");
  await expect(explorer.locator('[data-event="t_0"]')).toHaveText("0");
  await explorer.click("#remove-jump-0");
  await explorer.fill("#rate-scale", "2");
  await explorer.press("#rate-scale", "Enter");
  expect((await shown(explorer)).complaint).toBe("");
});

test("a(z) is exponential, a table, drawn by hand", async ({ explorer }) => {
  await explorer.selectOption("#rate-model", "exponential");
  const before = await shown(explorer);
  expect(before.picture.method).toBe("exact");
  await drag(explorer, "rate", "decay", 20, 0, 3);
  await drag(explorer, "rate", "amplitude", -10, 0, 3);
  await explorer.fill("#rate-decay", "0.4");
  await explorer.press("#rate-decay", "Enter");
  expect((await shown(explorer)).toml).toContain("decay = 0.4");
  await explorer.selectOption("#rate-model", "table");
  await drag(explorer, "rate", "point-2", 15, 0, 3);
  expect((await shown(explorer)).toml).toContain('model = "table"');
  await explorer.click("#draw-rate");
  const box = (await explorer.locator("#rate svg").boundingBox())!;
  await explorer.mouse.move(box.x + 60, box.y + box.height - 40);
  await explorer.mouse.down();
  for (let i = 1; i <= 12; ++i) await explorer.mouse.move(box.x + 60 + 40 * Math.sin(i / 3), box.y + box.height - 40 - (i / 12) * (box.height - 70));
  await explorer.mouse.up();
  expect((await shown(explorer)).complaint).toBe("");
  await expect(explorer.locator("#rate [data-handle^=point]")).toHaveCount(13);
});

test("every flux and all ends", async ({ explorer }) => {
  const names = await explorer.$$eval("#flux-model option", (options) => options.map((o) => (o as HTMLOptionElement).value));
  expect(names).toHaveLength(9);
  for (const name of names) {
    await explorer.selectOption("#flux-model", name);
    const { complaint, toml } = await shown(explorer);
    expect(complaint, name).toBe("");
    expect(toml).toContain(`model = "${name}"`);
  }
  await explorer.selectOption("#flux-model", "table");
  await explorer.fill("#flux-point-2", "-0.3");
  await explorer.press("#flux-point-2", "Enter");
  expect((await shown(explorer)).toml).toMatch(/values = \[ 0(\.0)?, -0\.2, -0\.3, -0\.12, 0(\.0)? \]/);
  await explorer.selectOption("#flux-model", "cubic");
  await explorer.fill("#flux-gamma", "0.3");
  await explorer.press("#flux-gamma", "Enter");
  for (const ends of ["open", "periodic", "walls", "open"]) {
    await explorer.selectOption("#ends", ends);
    expect((await shown(explorer)).complaint, ends).toBe("");
  }
  await explorer.fill("#outside-top-0", "0.5");
  await explorer.press("#outside-top-0", "Enter");
  expect((await shown(explorer)).toml).toContain("0.5");
});

test("a number that is not allowed is refused in the words of the program", async ({ explorer }) => {
  await explorer.fill("#rate-0", "-1");
  await explorer.press("#rate-0", "Enter");
  await expect(explorer.locator("#complaint")).toContainText("shear_rate.values[0] = -1");
  await explorer.click("#undo");
  await expect(explorer.locator("#complaint")).toBeHidden();
});

test("methods side by side: errors fall as resolutions are slid", async ({ explorer }) => {
  await explorer.click("#tab-methods");
  await expect(explorer.locator("#error-tracked")).toContainText("e-");
  const error = async (id: string): Promise<number> => Number(await explorer.locator(`#error-${id}`).textContent());
  const coarse = { tracked: await error("tracked"), grid: await error("grid") };
  await expect(explorer.locator("#lesson")).toContainText(/^For the error of front tracking as slid, \d\.\de-\d in [\d.]+ ms, engquist-osher needs about \d00 cells and [\d.]+ ms, [\d.]+ times as long/, { timeout: 20_000 });
  await explorer.locator("#resolution").fill("200");
  await explorer.locator("#cells").fill("800");
  expect(await error("tracked")).toBeLessThan(coarse.tracked / 3);
  expect(await error("grid")).toBeLessThan(coarse.grid / 2);
  await expect(explorer.locator("#lesson")).toContainText("needs more than 6400 cells if it goes on so");
  for (const scheme of ["godunov", "muscl", "engquist-osher"]) {
    await explorer.selectOption("#scheme", scheme);
    expect(await error("grid")).toBeGreaterThan(0);
  }
});

test("collisions are stepped through, each with its Riemann problem", async ({ explorer }) => {
  await explorer.click("#tab-collisions");
  await expect(explorer.locator("#collision-count")).toContainText("1 of");
  const first = (await shown(explorer)).t;
  for (let i = 0; i < 4; ++i) await explorer.click("#collision-next");
  await explorer.click("#collision-before");
  await expect(explorer.locator("#collision-count")).toContainText("4 of");
  expect((await shown(explorer)).t).toBeGreaterThan(first);
  await expect(explorer.locator("#collision-words")).toContainText("in,");
  await expect(explorer.locator("#panel-collisions .chord.incoming")).not.toHaveCount(0);
  await expect(explorer.locator("#panel-collisions .chord.outgoing")).not.toHaveCount(0);
  await expect(explorer.locator("#collision-fronts tbody tr")).toHaveCount(await explorer.locator("#panel-collisions .chord").count());
  await explorer.locator("#collision-index").fill("2");
  await expect(explorer.locator("#collision-count")).toContainText("3 of");
  await explorer.locator("#fan-step").fill("500");
  await expect(explorer.locator("#collision-count")).not.toContainText("of 1 ");
});

test("a time of the plane is pressed: its profile, why it is when it is, and the sum that it is", async ({ explorer }) => {
  await explorer.locator('#plane [data-event-mark="t_1"] circle').click();
  expect((await shown(explorer)).t).toBe(1.6129032258064517);
  await expect(explorer.locator("#why-t_1")).toContainText("why the bed is about as well mixed");
  await expect(explorer.locator("#why-t_1")).toContainText("(1 - 0.5) / 0.31 = 1.613");
  await explorer.click('[aria-controls="why-t_c"]');
  await expect(explorer.locator("#why-t_c")).toContainText("(0.5 - 0.29) / 0.31 = 0.6774");
  await explorer.click('[aria-controls="why-t_0"]');
  await expect(explorer.locator("#why-t_0")).toContainText("(0.5 - 0.29) / 0.31 + (0.29 - 0) / 2.4 = 0.7983");
  await expect(explorer.locator("#mixing figcaption")).toContainText("at t = 1.613; largest");
});

test("what is not grains is not called so", async ({ explorer }) => {
  await expect(explorer.locator("#scale")).toContainText("φ, share of small grains: 0 1");
  await explorer.selectOption("#flux-model", "lwr");
  await expect(explorer.locator("#scale")).toContainText("density of cars");
  await explorer.click('[aria-controls="why-t_0"]');
  await expect(explorer.locator("#why-t_0")).not.toContainText("grains");
  await explorer.selectOption("#flux-model", "burgers");
  await expect(explorer.locator("#scale")).toContainText("φ: -1 1");
});

test("a layer is cut in two, made slow, and the times say what they were", async ({ explorer }) => {
  await explorer.click("#split-layer-1");
  await explorer.fill("#rate-1", "0.1");
  await explorer.press("#rate-1", "Enter");
  const { toml, picture } = await shown(explorer);
  expect(toml).toContain("breaks = [ 0.29, 0.645 ]");
  await expect(explorer.locator("#events .was").last()).toContainText("was 8.781"); // of the cut alone
  await explorer.click("#undo");
  await expect(explorer.locator("#events .was").last()).toContainText(`was ${Number(picture.events!.tStar.toPrecision(4))}`);
});

test("names of times do not lie on each other, crowded as they are", async ({ explorer }) => {
  await explorer.click("#tab-fit");
  await explorer.selectOption("#dataset", { index: 1 }); // five layers, far beyond t*
  const boxes = await explorer.$$eval("#plane .event text", (texts) => texts.map((t) => t.getBoundingClientRect()).map((b) => ({ left: b.left, right: b.right, top: b.top + 3, bottom: b.bottom - 3 })));
  expect(boxes.length).toBeGreaterThan(5);
  const clashes = boxes.flatMap((a, i) => boxes.slice(i + 1).filter((b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom));
  expect(clashes).toEqual([]);
});

test("knobs of the start lie on it, in a bed with pores too", async ({ explorer }) => {
  await explorer.selectOption("#guided", "mixes-first");
  const [knob, at] = await explorer.evaluate(() => {
    const { profile } = (window as unknown as { shearfront: { profile: { x(phi: number): number; svg: SVGSVGElement } } }).shearfront;
    const box = profile.svg.querySelector('[data-handle="state-1"] .knob')!.getBoundingClientRect();
    return [box.left + box.width / 2 - profile.svg.getBoundingClientRect().left, profile.x(0.64)];
  });
  expect(Math.abs(knob! - at!)).toBeLessThan(1);
  await drag(explorer, "profile", "state-1", -20, 0);
  expect((await shown(explorer)).complaint).toBe("");
});

test("theme, text alternatives, names of all controls", async ({ explorer }) => {
  const paper = (): Promise<string> => explorer.evaluate(() => getComputedStyle(document.body).backgroundColor);
  await explorer.selectOption("#theme", "dark");
  const dark = await paper();
  await explorer.selectOption("#theme", "light");
  expect(await paper()).not.toBe(dark);
  await explorer.click("#reading summary");
  await expect(explorer.locator("#reading-words")).toContainText("t_1, first wave at the top: 1.613");
  await expect(explorer.locator("#reading tbody tr")).toHaveCount(11);
  const nameless = await explorer.evaluate(() =>
    [...document.querySelectorAll("svg[role], input, select, button, [role=slider]")].filter((e) => {
      if (e.closest("[hidden]") || e.getAttribute("type") === "file") return false;
      const labels = (e as HTMLInputElement).labels;
      return !(e.getAttribute("aria-label") || e.textContent?.trim() || (labels && labels.length > 0));
    }).map((e) => e.outerHTML.slice(0, 120)));
  expect(nameless).toEqual([]);
});
