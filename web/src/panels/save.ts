// SPDX-License-Identifier: BSD-3-Clause
// What is on the screen as files: pictures, numbers, the scene and the fit for the program.
import type { App } from "../app.ts";
import { spread } from "../bed/picture.ts";
import { phiInWords } from "../bed/words.ts";
import { css } from "../view/colours.ts";
import { brief } from "../view/numbers.ts";
import { html, svg } from "../view/svg.ts";
import type { FitTab } from "./fit_tab.ts";

function give(name: string, content: Blob): void {
  const link = html("a", { href: URL.createObjectURL(content), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** phi and M as `shearfront solve -o` writes them. */
export function csvOf(app: App): string {
  const { picture } = app;
  const times = spread(0, picture.tMax, 41);
  const heights = spread(picture.facts.bottom, picture.facts.top, 41);
  const { phi, M } = app.engine.solve(picture.method, times, heights);
  return "t,z,phi,M\n" + times.flatMap((t, i) => heights.map((z, j) => `${t},${z},${phi[i * heights.length + j]},${M[i * heights.length + j]}\n`)).join("");
}

/** The plane as one SVG: the canvas inside as an image, colours of the page written out. */
export function svgOf(app: App): string {
  const { plane } = app;
  const copy = plane.svg.cloneNode(true) as SVGSVGElement;
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  const originals = plane.svg.querySelectorAll("*");
  copy.querySelectorAll("*").forEach((element, i) => {
    const style = getComputedStyle(originals[i]!);
    for (const key of ["fill", "stroke", "stroke-width", "stroke-dasharray", "opacity", "font-size", "font-family", "paint-order"]) element.setAttribute(key, style.getPropertyValue(key));
  });
  copy.querySelectorAll(".handle, .now").forEach((element) => element.remove());
  const paper = getComputedStyle(document.body).backgroundColor;
  const { width, height } = plane.frame;
  const image = `<rect width="${width}" height="${height + LEGEND}" fill="${paper}"/><image href="${plane.canvas.toDataURL("image/png")}" width="${width}" height="${height}"/>`;
  for (const [key, value] of Object.entries({ viewBox: `0 0 ${width} ${height + LEGEND}`, width, height: height + LEGEND })) copy.setAttribute(key, String(value));
  copy.append(legend(app, height));
  const text = new XMLSerializer().serializeToString(copy);
  return text.replace(/^(<svg[^>]*>)/, `$1${image}`);
}

const LEGEND = 30; // pixels below the plane

/** What the colours stand for, and which bed it is. */
function legend(app: App, top: number): SVGGElement {
  const { lowest, highest } = app.picture.facts;
  const words = phiInWords(app.scene);
  const style = { y: top + 18, "font-size": 13, "font-family": getComputedStyle(document.body).fontFamily, fill: getComputedStyle(document.body).color };
  const before = `φ${words && ", " + words}: ${brief(lowest)}`;
  const left = app.plane.frame.left;
  const bar = left + 7.5 * before.length + 8;
  const group = svg("g", {}, undefined);
  group.append(svg("text", { ...style, x: left }, before));
  for (let i = 0; i < 60; ++i) group.append(svg("rect", { x: bar + 2 * i, y: top + 8, width: 2.5, height: 11, fill: css(i / 59) }));
  group.append(svg("text", { ...style, x: bar + 128 }, brief(highest)));
  group.append(svg("text", { ...style, x: app.plane.frame.width - 14, "text-anchor": "end" }, String(app.scene["name"] ?? "")));
  return group;
}

async function pngOf(app: App): Promise<Blob> {
  const { width } = app.plane.frame;
  const height = app.plane.frame.height + LEGEND;
  const image = new Image();
  image.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(svgOf(app));
  await image.decode();
  const canvas = html("canvas", { width: width * 2, height: height * 2 });
  canvas.getContext("2d")!.drawImage(image, 0, 0, width * 2, height * 2);
  return new Promise((done, fail) => canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error("no picture"))), "image/png"));
}

export function saveMenu(app: App, fit: FitTab): HTMLElement {
  const text = (content: string, type: string): Blob => new Blob([content], { type });
  const files: [string, () => Blob | Promise<Blob>][] = [
    ["plane.png", () => pngOf(app)],
    ["plane.svg", () => text(svgOf(app), "image/svg+xml")],
    ["solution.csv", () => text(csvOf(app), "text/csv")],
    ["scene.toml", () => text(app.toml, "text/plain")],
    ["fit.toml", () => text(fit.fitToml, "text/plain")],
    ["observations.csv", () => text(fit.observationsCsv, "text/csv")],
  ];
  const menu = html("details", { id: "save", class: "menu" }, html("summary", {}, "save"));
  const list = html("div", {});
  for (const [name, make] of files) {
    const button = html("button", { type: "button", id: `save-${name.replace(".", "-")}` }, name);
    button.addEventListener("click", () => {
      void Promise.resolve(make()).then((blob) => give(name, blob));
      menu.open = false;
    });
    list.append(button);
  }
  menu.append(list);
  return menu;
}
