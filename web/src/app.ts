// SPDX-License-Identifier: BSD-3-Clause
// The page at work: one scene with its history, the time shown, and everything drawn from them.
import { endsOf } from "./bed/edits.ts";
import { namedTimes, type NamedTime } from "./bed/event_list.ts";
import { History } from "./bed/history.ts";
import { toHash } from "./bed/link.ts";
import { COARSE, columnTimes, FINE, makePicture, middles, type Picture, profileAt, type Raster } from "./bed/picture.ts";
import { type Scene, readScene, unitsOf, writeScene } from "./bed/scene.ts";
import { mixingAt } from "./bed/why.ts";
import { phiInWords } from "./bed/words.ts";
import { type Engine, type ObservedData, Refusal } from "./engine/engine.ts";
import { profileHandles, planeHandles, rateHandles } from "./panels/handles.ts";
import { widestTick } from "./view/axes.ts";
import { drawMixing } from "./view/mixing.ts";
import { brief, milliseconds, withUnit } from "./view/numbers.ts";
import { Panel } from "./view/panel.ts";
import { drawPlane, eventPlace, planeInWords, type PlaneMarks } from "./view/plane.ts";
import { type Curve, drawProfile } from "./view/profile.ts";
import { drawRate } from "./view/rate.ts";
import { drawnRate } from "./bed/edits.ts";

/** Told after every change of the scene or of the time. */
export interface Listener {
  sceneChanged?(isDrag: boolean): void;
  timeChanged?(): void;
  eventChosen?(id: string): void;
}

const IDLE_MS = 140;

export class App {
  readonly plane: Panel;
  readonly profile: Panel;
  readonly rate: Panel;
  readonly mixing: Panel;
  readonly history: History<Scene>;
  picture: Picture;
  raster: Raster;
  t = 0;
  /** Chosen by the user; otherwise as long as there is something to see. */
  timeShown: number | undefined;
  showFronts = true;
  frontResolution = 0.04;
  collision: { t: number; z: number } | undefined;
  data: ObservedData = { quantity: "point", understood: "", notes: [], rows: [] };
  complaint = "";
  /** Event times before the last change, by their names. */
  timesBefore: ReadonlyMap<string, number> = new Map();
  private widest = 1;
  private isDragging = false;
  private beforeDrag: Scene | undefined;
  private isDrawing = false;
  private idle = 0;
  private turn = 0;
  private start: { of: Picture; curve: Curve } | undefined;
  private stroke: { x: number; y: number }[] = [];
  private readonly listeners: Listener[] = [];

  constructor(readonly engine: Engine, readonly module: WebAssembly.Module, toml: string) {
    const scene = readScene(toml);
    this.history = new History(scene);
    const watch = { begin: () => this.beginDrag(), end: () => this.endDrag() };
    this.plane = new Panel("plane", "φ over time t and height z", watch);
    this.profile = new Panel("profile", "φ over z", watch);
    this.rate = new Panel("rate", "segregation speed s a(z)", watch);
    this.mixing = new Panel("mixing", "mixing Ψ", watch);
    this.picture = makePicture(engine, writeScene(scene), FINE);
    this.raster = this.picture.raster;
    this.rate.frame.left = this.profile.frame.left = 30;
    this.mixing.frame = { ...this.mixing.frame, top: 6, bottom: 8 };
    for (const panel of [this.plane, this.mixing]) panel.onHover = (t) => this.setTime(t);
    this.plane.onPress = (x, y, reach) => this.pressEvent(x, y, reach);
    this.settle();
  }

  listen(listener: Listener): void {
    this.listeners.push(listener);
  }

  get scene(): Scene {
    return this.history.present;
  }
  get toml(): string {
    return writeScene(this.scene);
  }
  get times(): NamedTime[] {
    const { events, facts } = this.picture;
    return events ? namedTimes(events, facts.top, facts.bottom) : [];
  }

  private remember(): void {
    this.timesBefore = new Map(this.times.map((m) => [m.id, m.t]));
  }

  /** An event of the plane, if one is near: its profile is shown, and why it is when it is. */
  private pressEvent(x: number, y: number, reach: number): (() => void) | undefined {
    const chosen = this.times.filter((m) => Number.isFinite(m.t) && m.t <= this.picture.tMax).find((m) => {
      const [ex, ey] = eventPlace(this.plane, this.picture, m);
      return Math.hypot(ex - x, ey - y) < reach;
    });
    if (!chosen) return undefined;
    this.setTime(chosen.t);
    return () => { for (const listener of this.listeners) listener.eventChosen?.(chosen.id); };
  }

  /** Another scene altogether: one step to undo. */
  open(scene: Scene, t?: number): void {
    this.timeShown = undefined;
    this.collision = undefined;
    this.history.push(scene);
    this.timesBefore = new Map();
    this.update(false);
    this.setTime(t ?? Math.min(this.t, this.picture.tMax));
  }

  /** A change by a control: one step to undo. */
  change(scene: Scene): void {
    if (this.isDragging) this.history.replace(scene);
    else {
      this.remember();
      this.history.push(scene);
    }
    this.update(this.isDragging);
  }

  undo(): void {
    this.remember();
    this.history.undo();
    this.update(false);
  }
  redo(): void {
    this.remember();
    this.history.redo();
    this.update(false);
  }

  setTime(t: number): void {
    this.t = Math.min(this.picture.tMax, Math.max(0, t));
    this.drawTime();
    for (const listener of this.listeners) listener.timeChanged?.();
  }

  setTimeShown(t: number | undefined): void {
    this.timeShown = t && t > 0 ? t : undefined;
    this.update(false);
  }

  /** The next stroke on the panel of rates becomes a(z). */
  drawByHand(isOn: boolean): void {
    this.isDrawing = isOn;
    this.rate.figure.classList.toggle("drawing", isOn);
    this.rate.onStroke = !isOn ? undefined : (points, done) => {
      this.stroke = points;
      if (!done) return this.draw();
      this.stroke = [];
      this.drawByHand(false);
      this.change(drawnRate(this.scene, points.map((p) => ({ z: p.y, speed: Math.max(this.widest * 1e-3, p.x) }))));
    };
    this.draw();
  }

  private beginDrag(): void {
    this.isDragging = true;
    this.beforeDrag = this.scene;
    this.remember();
    this.history.push(this.scene);
  }
  private endDrag(): void {
    this.isDragging = false;
    const after = this.scene;
    this.history.undo();
    if (after !== this.beforeDrag) this.history.push(after);
    this.update(false);
  }

  /** Everything anew; while dragging coarser, and with the axes as they are. */
  update(isDrag: boolean): void {
    const tMax = this.timeShown ?? (isDrag ? this.picture.tMax : undefined);
    const detail = isDrag ? COARSE : { ...FINE, frontStep: this.frontResolution };
    try {
      this.picture = makePicture(this.engine, this.toml, detail, tMax);
      this.complaint = "";
      this.raster = this.picture.raster;
      if (!isDrag) this.settle();
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      this.complaint = error.message;
    }
    this.t = Math.min(this.t, this.picture.tMax);
    this.draw();
    for (const listener of this.listeners) listener.sceneChanged?.(isDrag);
    window.clearTimeout(this.idle);
    if (!isDrag) this.idle = window.setTimeout(() => void this.refine(), IDLE_MS);
  }

  /** What is fixed while something is dragged. */
  private settle(): void {
    this.widest = 1.2 * Math.max(...this.picture.rate.speed);
  }

  /** Fronts as the page shows them, with steps of their own in the fans. */
  refreshFronts(): void {
    if (this.picture.fronts.length === 0 && this.picture.collisions.length === 0) return;
    try {
      Object.assign(this.picture, this.engine.fronts(this.frontResolution, this.picture.tMax), { frontStep: this.frontResolution });
    } catch {
      // Those of the raster stay.
    }
  }

  /** The plane by the method that answers for numbers, in slices that leave the page free. */
  private async refine(): Promise<void> {
    void this.share();
    const turn = ++this.turn;
    const { picture } = this;
    const { facts } = picture;
    const ratio = window.devicePixelRatio || 1;
    const columns = Math.round(Math.min(900, this.plane.inner.width * ratio));
    const rows = Math.round(Math.min(500, this.plane.inner.height * ratio));
    const times = columnTimes(picture.tMax, columns);
    const heights = middles(facts.bottom, facts.top, rows);
    const raster: Raster = { method: picture.method, columns, rows, phi: new Float64Array(columns * rows) };
    const finest = picture.method === "exact" ? 4 : columns;
    const method = picture.method === "front-tracking" ? "front-tracking resolution=0.01 max-collisions=300000" : picture.method;
    for (let from = 0, n = finest; from < columns; from += n) {
      const some = times.slice(from, from + n);
      try {
        raster.phi.set(this.engine.solve(method, some, heights).phi, from * rows);
      } catch {
        return; // the coarse plane stays
      }
      if (from + n >= columns) break;
      await new Promise((done) => setTimeout(done));
      if (turn !== this.turn || picture !== this.picture || this.isDragging) return;
    }
    if (turn !== this.turn || picture !== this.picture) return;
    this.raster = raster;
    this.draw();
    this.plane.figure.dataset["method"] = picture.method;
  }

  /** Puts the scene into the address. */
  async share(): Promise<void> {
    const hash = await toHash(this.toml);
    if (location.hash !== hash) window.history.replaceState(null, "", hash);
  }

  get labels(): { t: string; z: string; speed: string } {
    const units = unitsOf(this.scene);
    const speed = units.z && units.t ? `s a [${units.z}/${units.t}]` : "s a";
    return { t: units.t ? `t [${units.t}]` : "t", z: units.z ? `z [${units.z}]` : "z", speed };
  }

  private get marks(): PlaneMarks {
    return {
      t: this.t, times: this.times, data: this.data, collision: this.collision,
      showFronts: this.showFronts, labels: { x: this.labels.t, y: this.labels.z },
    };
  }

  resize(): void {
    for (const panel of [this.plane, this.profile, this.rate, this.mixing]) panel.resize();
    this.draw();
  }

  /** Room for the numbers of the axes of z. */
  private makeRoom(): void {
    const { top, bottom } = this.picture.facts;
    for (const [panel, least] of [[this.plane, 44], [this.mixing, 44], [this.profile, 30], [this.rate, 30]] as const)
      panel.setLeft(Math.max(least, 12 + 7 * widestTick(bottom, top, this.plane.frame.height)));
  }

  draw(): void {
    const begin = performance.now();
    const bed = { scene: this.scene, picture: this.picture, change: (scene: Scene) => this.change(scene) };
    const current = { ...bed };
    Object.defineProperty(current, "scene", { get: () => this.scene });
    this.makeRoom();
    drawPlane(this.plane, this.picture, this.raster, this.marks);
    this.plane.drawHandles(planeHandles(current));
    const most = Math.max(this.widest, 1.02 * Math.max(...this.picture.rate.speed));
    drawRate(this.rate, this.picture, most, this.stroke, this.labels.speed);
    this.rate.drawHandles(this.isDrawing ? [] : rateHandles(current, this.widest));
    drawMixing(this.mixing, this.picture, this.t, this.times);
    this.drawTime();
    this.profile.drawHandles(profileHandles(current));
    const ms = this.picture.ms + performance.now() - begin;
    this.plane.figure.dataset["ms"] = ms.toFixed(2);
    const state = document.getElementById("state");
    if (state) state.textContent = `${this.picture.method}, picture in ${milliseconds(ms)}`;
    this.plane.svg.setAttribute("aria-label", planeInWords(this.picture, this.times, String(this.scene["name"] ?? "A bed"), phiInWords(this.scene)));
  }

  /** What depends on the time alone. */
  private drawTime(): void {
    drawPlaneTime(this);
    const { facts } = this.picture;
    const data = nearestData(this.data, this.t, this.picture.tMax);
    try {
      const now = profileAt(this.engine, this.picture, this.t);
      if (this.start?.of !== this.picture) this.start = { of: this.picture, curve: profileAt(this.engine, this.picture, 0) };
      drawProfile(this.profile, this.picture, now, this.start.curve, data, "φ");
      this.profile.svg.setAttribute("aria-label", `phi over z at t = ${brief(this.t)}: from ${brief(now.phi[0]!)} at z = ${brief(facts.bottom)} to ${brief(now.phi.at(-1)!)} at z = ${brief(facts.top)}`);
    } catch {
      this.profile.below.replaceChildren();
    }
    const caption = this.profile.figure.querySelector("figcaption");
    const when = `t = ${withUnit(brief(this.t), unitsOf(this.scene).t)}`;
    if (caption) caption.textContent = `φ over z at ${when}`;
    const mixed = mixingAt(this.picture, this.t);
    const most = mixed && (mixed.isRising ? "still rising at the end" : `largest, ${mixed.most.toFixed(2)}, at t = ${withUnit(brief(Number(mixed.tMost.toPrecision(2))), unitsOf(this.scene).t)}`);
    this.mixing.figure.querySelector("figcaption")!.textContent = mixed ? `mixing Ψ, 0 apart to 1 even: ${mixed.psi.toFixed(2)} at ${when}; ${most}` : "";
    this.rate.svg.setAttribute("aria-label", `s a(z): ${brief(this.picture.rate.speed[0]!)} at the bottom, ${brief(this.picture.rate.speed.at(-1)!)} at the top; ends: ${endsOf(this.scene)}`);
  }
}

function drawPlaneTime(app: App): void {
  const x = app.plane.x(app.t);
  for (const line of app.plane.marks.querySelectorAll("line.now")) {
    line.setAttribute("x1", String(x));
    line.setAttribute("x2", String(x));
  }
  for (const line of app.mixing.marks.querySelectorAll("line.now")) {
    line.setAttribute("x1", String(app.mixing.x(app.t)));
    line.setAttribute("x2", String(app.mixing.x(app.t)));
  }
}

/** Observations of phi at the measured time next to t. */
function nearestData(data: ObservedData, t: number, tMax: number): ObservedData["rows"] {
  if (data.rows.length === 0 || (data.quantity !== "point" && data.quantity !== "bin")) return [];
  const nearest = data.rows.reduce((best, row) => (Math.abs(row.t - t) < Math.abs(best - t) ? row.t : best), Infinity);
  return Math.abs(nearest - t) < 0.1 * tMax ? data.rows.filter((row) => row.t === nearest) : [];
}
