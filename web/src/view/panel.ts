// SPDX-License-Identifier: BSD-3-Clause
// A picture with axes and with handles that can be dragged by pointer, finger or keys.
import { scaleLinear, type ScaleLinear } from "d3-scale";
import { drawXAxis, drawYAxis, type Frame } from "./axes.ts";
import { html, join, set, svg } from "./svg.ts";

export interface Handle {
  id: string;
  label: string;
  text: string; // its value in words
  value: number;
  x: number; // where it is drawn, in the units of the axes
  y: number;
  direction: "x" | "y";
  drag(x: number, y: number): void; // to a place in the units of the axes
  step(by: number): void; // in parts of the axis
}

/** Told when a drag begins and ends: what lies between is one step to undo. */
export interface DragWatch {
  begin(): void;
  end(): void;
}

const REACH = 24; // pixels from which a finger takes a handle

export class Panel {
  readonly figure: HTMLElement;
  readonly canvas = html("canvas", { "aria-hidden": "true" });
  readonly svg = svg("svg", { role: "group" });
  readonly below = svg("g"); // drawn under the handles
  readonly marks = svg("g", { "aria-hidden": "true" });
  readonly x: ScaleLinear<number, number> = scaleLinear();
  readonly y: ScaleLinear<number, number> = scaleLinear();
  frame: Frame = { width: 0, height: 0, left: 44, right: 14, top: 26, bottom: 34 };
  private readonly xAxis = svg("g");
  private readonly yAxis = svg("g");
  private readonly handleGroup = svg("g");
  private handles: Handle[] = [];
  private held: Handle | undefined;
  private pressed: (() => void) | undefined; // while the pointer is on something that is no handle, it chooses no time
  /** Where the pointer is when it holds nothing, in the units of the axes. */
  onHover: (x: number, y: number) => void = () => undefined;
  /** Told first of a press on no handle; what a click there does, if something is there. */
  onPress: (px: number, py: number, reach: number) => (() => void) | undefined = () => undefined;
  onStroke: ((points: { x: number; y: number }[], done: boolean) => void) | undefined;
  private stroke: { x: number; y: number }[] = [];

  constructor(id: string, caption: string, private readonly watch: DragWatch) {
    this.svg.append(this.below, this.xAxis, this.yAxis, this.marks, this.handleGroup);
    this.figure = html("figure", { id, class: "panel" }, html("figcaption", {}, caption), html("div", { class: "picture" }, this.canvas, this.svg));
    this.svg.addEventListener("pointerdown", (event) => this.down(event));
    this.svg.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"] as const) this.svg.addEventListener(name, () => this.up());
    // Not before the click: what scrolls the page would have it land elsewhere.
    this.svg.addEventListener("click", () => {
      this.pressed?.();
      this.pressed = undefined;
    });
    this.svg.addEventListener("pointerleave", (event) => { if (event.pointerType === "mouse") this.pressed = undefined; });
    this.svg.addEventListener("keydown", (event) => this.key(event));
  }

  /** Takes the size that the page gives it. */
  resize(): void {
    const box = this.svg.parentElement!.getBoundingClientRect();
    this.frame = { ...this.frame, width: Math.max(80, box.width), height: Math.max(40, box.height) };
    set(this.svg, { viewBox: `0 0 ${this.frame.width} ${this.frame.height}`, width: this.frame.width, height: this.frame.height });
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(this.frame.width * ratio);
    this.canvas.height = Math.round(this.frame.height * ratio);
    this.setLeft(this.frame.left);
    this.y.range([this.frame.height - this.frame.bottom, this.frame.top]);
  }

  setLeft(left: number): void {
    this.frame = { ...this.frame, left };
    this.x.range([left, this.frame.width - this.frame.right]);
  }

  get inner(): { left: number; top: number; width: number; height: number } {
    const f = this.frame;
    return { left: f.left, top: f.top, width: f.width - f.left - f.right, height: f.height - f.top - f.bottom };
  }

  /** The canvas in pixels of the page, cleared. */
  context(): CanvasRenderingContext2D {
    const context = this.canvas.getContext("2d")!;
    const ratio = this.canvas.width / this.frame.width;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.frame.width, this.frame.height);
    return context;
  }

  drawAxes(xTitle: string | undefined, yTitle: string): void {
    if (xTitle !== undefined) drawXAxis(this.xAxis, this.frame, this.x, xTitle);
    drawYAxis(this.yAxis, this.frame, this.y, yTitle);
  }

  drawHandles(handles: Handle[]): void {
    this.handles = handles;
    if (this.held) this.held = handles.find((h) => h.id === this.held!.id) ?? this.held;
    join(
      this.handleGroup,
      handles,
      (h) => h.id,
      (h) => {
        const g = svg("g", { tabindex: 0, role: "slider", class: `handle ${h.direction}`, "data-handle": h.id });
        g.append(svg("circle", { r: 13, class: "reach" }), svg("circle", { r: 6, class: "knob" }));
        return g;
      },
      (g, h) => {
        set(g, {
          transform: `translate(${this.x(h.x).toFixed(1)} ${this.y(h.y).toFixed(1)})`,
          "aria-label": h.label, "aria-valuenow": h.value, "aria-valuetext": h.text,
          "aria-orientation": h.direction === "x" ? "horizontal" : "vertical",
        });
      },
    );
  }

  private place(event: PointerEvent): { x: number; y: number; px: number; py: number } {
    const box = this.svg.getBoundingClientRect();
    const px = event.clientX - box.left;
    const py = event.clientY - box.top;
    return { x: this.x.invert(px), y: this.y.invert(py), px, py };
  }

  private nearest(px: number, py: number, reach: number): Handle | undefined {
    let best: Handle | undefined;
    let least = reach;
    for (const h of this.handles) {
      const d = Math.hypot(this.x(h.x) - px, this.y(h.y) - py);
      if (d < least) [best, least] = [h, d];
    }
    return best;
  }

  private down(event: PointerEvent): void {
    const at = this.place(event);
    if (this.onStroke) {
      this.stroke = [at];
      this.svg.setPointerCapture(event.pointerId);
      return;
    }
    const reach = event.pointerType === "mouse" ? REACH / 2 : REACH;
    this.held = this.nearest(at.px, at.py, reach);
    if (!this.held) {
      this.pressed = this.onPress(at.px, at.py, reach);
      if (!this.pressed) this.onHover(at.x, at.y);
      return;
    }
    event.preventDefault();
    this.svg.setPointerCapture(event.pointerId);
    const element = this.handleGroup.querySelector<SVGGElement>(`[data-handle="${this.held.id}"]`);
    element?.focus({ preventScroll: true });
    this.watch.begin();
  }

  private move(event: PointerEvent): void {
    const at = this.place(event);
    if (this.onStroke && this.stroke.length > 0) {
      this.stroke.push(at);
      this.onStroke(this.stroke, false);
    } else if (this.held) {
      this.held.drag(at.x, at.y);
    } else if (!this.onStroke && !this.pressed) {
      this.onHover(at.x, at.y);
    }
  }

  private up(): void {
    if (this.onStroke && this.stroke.length > 0) {
      this.onStroke(this.stroke, true);
      this.stroke = [];
    }
    if (!this.held) return;
    this.held = undefined;
    this.watch.end();
  }

  private key(event: KeyboardEvent): void {
    const id = (event.target as Element).getAttribute("data-handle");
    const handle = this.handles.find((h) => h.id === id);
    const directions: Record<string, number> = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 10, PageDown: -10 };
    const steps = directions[event.key];
    if (!handle || steps === undefined) return;
    event.preventDefault();
    this.watch.begin();
    handle.step((steps * (event.shiftKey ? 10 : 1)) / 100);
    this.watch.end();
  }
}
