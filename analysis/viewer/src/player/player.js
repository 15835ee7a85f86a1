/** A player: views of runs side by side, their time, their colours, and what the user does with them. */
import { Vector3 } from "three";

import { pageData } from "../page/data.js";
import { number, withUnit } from "../page/numbers.js";
import { pickedTriangle } from "./cloth.js";
import { Compare } from "./compare.js";
import { Controls, SPEEDS } from "./controls.js";
import { pressed } from "./keys.js";
import { columnsFor, heightFor, MOST } from "./layout.js";
import { followPointers } from "./orbit.js";
import { springsOf } from "./picked.js";
import { Recorder } from "./recorder.js";
import { framesOf, runOf } from "./runs.js";
import { mapTexture } from "./shading.js";
import { Stage } from "./stage.js";
import { anchorViews, View } from "./view.js";

const REFINE_MS = 220;
const TELL_MS = 120; // between updates of the running clock: text is slow to draw without a graphics card
const calm = matchMedia("(prefers-reduced-motion: reduce)");

export class Player {
  /** @param {HTMLElement} element with data-runs: ids, a space between them; perhaps data-shown: how many of
   *   these runs are shown at first */
  constructor(element) {
    this.element = element;
    this.ids = element.dataset.runs.split(" ").filter(Boolean);
    this.shownIds = this.ids.slice(0, Math.min(element.dataset.shown ?? MOST, MOST));
    this.time = 0;
    this.speed = 1;
    this.loop = false;
    this.linked = true;
    this.lines = true;
    this.key = "stretch";
    this.referenceId = null;
    this.views = [];
    this.cells = [];
    this.drawn = 0; // pictures so far
    this.compare = new Compare(pageData().quantities);
    this.controls = new Controls(this);
    this.recorder = new Recorder(this);
    element.replaceChildren(...this.controls.parts);
    element.classList.add("player-ready");
    element.setAttribute("role", "group");
    element.setAttribute("aria-label", "Player of the cloth");
    element.addEventListener("keydown", (event) => pressed(this, event));
    this.resizes = new ResizeObserver(() => this.#resized());
    this.resizes.observe(this.controls.stage);
    this.theme = matchMedia("(prefers-color-scheme: dark)");
    this.theme.addEventListener("change", this.#restyled);
    this.print = matchMedia("print");
    this.print.addEventListener("change", this.#printed);
    element.addEventListener("fullscreenchange", () => this.#resized());
  }

  // --- runs

  /** Reads the runs that are shown, and draws them. */
  async start() {
    const turn = this.turn = {};
    this.playing = false;
    this.#dropViews();
    const runs = this.shownIds.map(runOf);
    this.controls.showCells(runs);
    // The stage comes first, so that the graphics start while frames are read
    if (runs.some((run) => run.frames) && !this.#makeStage()) return;
    const loaded = await Promise.all(runs.map(async (run) => {
      if (!run.frames) return { run, problem: run.remedy ?? "This run has no recorded frames." };
      try {
        return { run, frames: await framesOf(run) };
      } catch (error) {
        return { run, problem: `Its frames can't be read: ${error.message}` };
      }
    }));
    if (this.turn !== turn) return;
    loaded.forEach(({ run, frames, problem }, i) => {
      const cell = this.controls.cells[i];
      if (problem) return this.controls.problem(cell, problem);
      const view = new View(run, frames, pageData().colours);
      this.views.push(view);
      this.cells.push({ view, element: cell });
      followPointers(cell, (change) => this.move(change, view), (x, y) => this.#clicked(view, cell, x, y));
      cell.addEventListener("focus", () => { this.focused = view; });
    });
    this.controls.showRuns(runs);
    if (!this.views.length) return this.controls.disable();
    this.first = Math.min(...this.views.map((view) => view.frames.times[0]));
    this.last = Math.max(...this.views.map((view) => view.frames.times.at(-1)));
    this.time = Math.min(Math.max(this.time, this.first), this.last);
    this.controls.ready();
    this.#resized();
    this.#decodeRest(turn);
    if (!calm.matches && !this.played && this.last > this.first) this.#playWhenDecoded(turn);
  }

  async #decodeRest(turn) {
    const wanted = () => this.turn === turn && !this.disposed;
    await Promise.all(this.views.map((view) => view.frames.decodeAll(wanted)));
    if (!wanted()) return;
    this.decoded = true;
    this.#frameAll();
    this.draw();
    this.element.dataset.decoded = "";
  }

  async #playWhenDecoded(turn) {
    while (!this.decoded && this.turn === turn) await new Promise((resume) => setTimeout(resume, 50));
    if (this.turn === turn && !this.played && !this.disposed) this.play();
  }

  /** Shows only these of the player's runs. */
  show(ids) {
    this.shownIds = ids.slice(0, MOST);
    if (!this.shownIds.includes(this.referenceId)) this.referenceId = null;
    this.decoded = false;
    delete this.element.dataset.decoded;
    return this.start();
  }

  #makeStage() {
    if (this.stage) return true;
    try {
      this.stage = new Stage(this.controls.canvas);
    } catch {
      this.controls.disable("The cloth can't be drawn: this browser has no WebGL 2. Use a newer browser, " +
        "or turn on hardware acceleration in the settings of this browser.");
      return false;
    }
    const { maps } = pageData().colours;
    this.textures = Object.fromEntries(Object.entries(maps).map(([name, hex]) => [name, mapTexture(hex)]));
    this.controls.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.controls.canvas.addEventListener("webglcontextrestored", () => { this.#resized(); });
    return true;
  }

  #dropViews() {
    for (const view of this.views) view.dispose();
    this.views = [];
    this.cells = [];
    this.focused = null;
    this.compare.ranges.clear();
  }

  get reference() {
    return this.views.find((view) => view.run.id === this.referenceId) ?? null;
  }

  // --- size and cameras

  #resized() {
    if (!this.stage || !this.views.length) return;
    const { stage } = this.controls;
    const full = this.isFull();
    const width = stage.clientWidth;
    const count = this.controls.cells.length;
    this.controls.layOut(columnsFor(count, width), Math.ceil(count / columnsFor(count, width)),
                         full ? null : heightFor(count, width, innerHeight));
    const height = stage.clientHeight;
    if (!width || !height) return;
    this.stage.resize(width, height);
    this.#restyled();
    const box = stage.getBoundingClientRect();
    for (const cell of this.cells) {
      const place = cell.element.getBoundingClientRect();
      Object.assign(cell, { x: place.left - box.left, y: place.top - box.top, width: place.width,
                            height: place.height });
    }
    this.#frameAll();
    this.drawNow(true, true); // at once: the canvas is empty
    this.draw();
  }

  /** Points linked cameras at the cloth of all views, other cameras at the cloth of their view. A camera that
   * the user has moved stays. */
  #frameAll() {
    if (!this.cells.length || !this.cells[0].width) return;
    const points = anchorViews(this.views);
    if (this.linked) {
      const aspect = Math.min(...this.cells.map(({ width, height }) => width / height));
      const [first, ...others] = this.views;
      first.orbit.frame(points.flat(), aspect);
      for (const view of others) view.orbit.copy(first.orbit);
    } else this.cells.forEach(({ view, width, height }, i) => view.orbit.frame(points[i], width / height));
  }

  #restyled = () => {
    if (!this.stage) return;
    const style = getComputedStyle(this.element);
    for (const end of ["top", "bottom"]) {
      const hex = style.getPropertyValue(`--stage-${end}`).trim() || "#f2f4f6";
      this.stage.ground[end].set(...[1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255));
    }
    this.draw();
  };

  /** Draws the current picture at once for print, on a white background. */
  #printed = () => {
    this.#restyled();
    this.drawNow();
  };

  /** Moves all cameras if they are linked, otherwise the camera of one view. */
  move(change, view = this.focused ?? this.views[0]) {
    if (!view) return;
    change(view.orbit);
    if (this.linked) for (const other of this.views) if (other !== view) other.orbit.copy(view.orbit);
    this.draw();
  }

  setLinked(linked) {
    this.linked = linked;
    const from = (this.focused ?? this.views[0])?.orbit;
    if (linked && from) for (const view of this.views) view.orbit.copy(from);
    this.controls.update();
    this.draw();
  }

  resetCameras() {
    for (const view of this.views) view.orbit.reset();
    this.#frameAll();
    this.draw();
  }

  isFull() {
    return document.fullscreenElement === this.element || this.element.classList.contains("player-filling");
  }

  async fullScreen() {
    if (this.isFull()) {
      this.element.classList.remove("player-filling");
      if (document.fullscreenElement) await document.exitFullscreen();
    } else {
      try {
        await this.element.requestFullscreen();
      } catch {
        this.element.classList.add("player-filling"); // for browsers that have full screen for videos only
      }
    }
    this.controls.update();
    this.#resized();
  }

  // --- time

  seek(time) {
    if (!this.views.length) return; // its frames are not read yet
    this.time = Math.min(Math.max(time, this.first), this.last);
    this.draw();
  }

  /** Goes forward by `count` recorded frames of all runs, or back if `count` is negative. */
  step(count) {
    if (!this.views.length) return;
    this.stop();
    const times = [...new Set(this.views.flatMap((view) => [...view.frames.times]))].sort((a, b) => a - b);
    let at = times.findLastIndex((time) => time <= this.time + 1e-9);
    at = Math.min(Math.max(at + count, 0), times.length - 1);
    this.seek(times[at]);
  }

  toggle() {
    if (this.playing) this.stop();
    else this.play();
  }

  play() {
    if (!this.views.length || this.playing) return;
    this.played = true;
    if (this.time >= this.last - 1e-9) this.time = this.first;
    this.playing = true;
    this.controls.update();
    let before = null;
    const tick = (now) => {
      if (!this.playing) return;
      if (before !== null) {
        if (this.changed) this.stage.judge(now - before);
        this.#advance((now - before) / 1000 * this.speed);
      }
      before = now;
      this.changed = this.drawNow(true);
      if (this.playing) requestAnimationFrame(tick);
      else this.draw();
    };
    requestAnimationFrame(tick);
  }

  #advance(seconds) {
    this.time += seconds;
    if (this.time < this.last) return;
    if (this.loop) this.time = this.first + (this.time - this.last) % Math.max(this.last - this.first, 1e-9);
    else {
      this.time = this.last;
      this.playing = false;
      this.controls.update();
    }
  }

  stop() {
    this.played = true;
    if (!this.playing) return;
    this.playing = false;
    this.controls.update();
    this.draw();
  }

  setSpeed(speed) {
    this.speed = speed;
    this.controls.update();
  }

  changeSpeed(by) {
    const at = SPEEDS.findIndex(([speed]) => speed === this.speed) + by;
    this.setSpeed(SPEEDS[Math.min(Math.max(at, 0), SPEEDS.length - 1)][0]);
  }

  setLoop(loop) {
    this.loop = loop;
    this.controls.update();
  }

  // --- colours

  setQuantity(key) {
    this.key = key;
    this.controls.update();
    this.draw();
  }

  nextQuantity(by) {
    const keys = this.compare.choices(this.reference).map((each) => each.key);
    this.setQuantity(keys[(keys.indexOf(this.key) + by + keys.length) % keys.length]);
  }

  /** Compares the other runs with this run; null: ends the comparison. */
  setReference(id) {
    const had = this.referenceId;
    this.referenceId = id;
    if (id && !had) this.key = "distance";
    if (!id && this.key === "distance") this.key = "stretch";
    for (const view of this.views) {
      const same = this.reference && view !== this.reference ? this.compare.map(view, this.reference) : null;
      view.overlay(same ? this.reference : null);
      this.controls.note(view, this.reference && view !== this.reference && !same
        ? "another cloth: not comparable"
        : view === this.reference ? "the other runs are compared with this run" : "");
    }
    this.controls.update();
    this.draw();
  }

  nextReference() {
    const ids = [null, ...this.views.map((view) => view.run.id)];
    if (ids.length > 2) this.setReference(ids[(ids.indexOf(this.referenceId) + 1) % ids.length]);
  }

  setRange(low, high) {
    this.compare.setRange(this.key, this.reference, [low, high]);
    this.draw();
  }

  setLines(lines) {
    this.lines = lines;
    this.controls.update();
    this.draw();
  }

  // --- drawing

  /** Draws a coarse picture soon, and a fine picture when nothing has changed for a moment. */
  draw() {
    if (this.disposed) return;
    clearTimeout(this.refining);
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      if (this.playing || this.recorder.recording) return;
      this.drawNow(true, true);
      this.refining = setTimeout(() => this.playing || this.recorder.recording || this.drawNow(), REFINE_MS);
    });
  }

  /** Draws a picture. Returns whether a view shows another frame than before. @param {boolean} moving the
   * picture may be coarse @param {boolean} always draws also if all frames are the same as before */
  drawNow(moving = false, always = !moving) {
    if (!this.stage || !this.views.length || this.disposed || !this.cells[0].width) return false;
    let changed = false;
    for (const view of this.views) changed = view.goTo(this.time) || changed;
    if (!always && !changed) return false;
    const { reference } = this;
    const quantity = this.compare.quantity(this.key, reference);
    const range = quantity.map ? this.compare.range(this.key, this.views, reference) : [0, 1];
    for (const view of this.views) {
      const state = `${view.frame} ${reference?.run.id} ${reference?.frame} ${this.key}`;
      if (view.coloured !== state) {
        const found = this.compare.values(this.key, view, reference);
        view.cloth.colour(found?.values ?? null, found?.smooth);
        view.coloured = state;
      }
      const { uniforms } = view.cloth.material;
      uniforms.map.value = quantity.map ? this.textures[quantity.map] : null;
      uniforms.range.value = range;
      uniforms.logarithmic.value = quantity.scale === "log";
      uniforms.lines.value = this.lines;
    }
    this.stage.draw(this.cells, moving);
    ++this.drawn;
    const now = performance.now();
    if (!this.playing || !(now - this.reportedAt < TELL_MS)) {
      this.controls.tell(quantity, range);
      this.reportedAt = now;
    }
    if (!this.playing || this.drawn % 8 === 0) this.#showPicked();
    return changed;
  }

  // --- values

  #clicked(view, cell, x, y) {
    cell.focus({ preventScroll: true });
    const { camera } = view;
    const box = { width: cell.clientWidth, height: cell.clientHeight };
    const origin = camera.position.clone();
    const direction = new Vector3(2 * x / box.width - 1, 1 - 2 * y / box.height, 0.5).unproject(camera)
      .sub(origin).normalize();
    const hit = pickedTriangle(origin.toArray(), direction.toArray(), view.cloth.positions, view.mesh.triangles);
    if (!hit) return this.clearPick();
    const corner = hit.shares.indexOf(Math.max(...hit.shares));
    this.pick(view, view.mesh.triangles[3 * hit.triangle + corner], hit.triangle);
  }

  /** Picks a vertex and a triangle (or null) of a view, and the nearest ones on the cloth of other views. */
  async pick(view, vertex, triangle) {
    const turn = this.pickTurn = {};
    const chosen = this.views.map((other) => {
      if (other === view) return { other, vertex, triangle };
      const map = this.compare.map(view, other);
      return map ? { other, vertex: map.vertex(vertex), triangle: triangle === null ? null : map.face(triangle) }
        : { other, vertex: null, triangle: null };
    });
    for (const { other, vertex: v, triangle: t } of chosen) other.picked.set(v, t, null);
    this.draw();
    this.#showPicked(); // at once, because draw() does it only in a later frame while the cloth plays
    for (const { other, vertex: v, triangle: t } of chosen) {
      if (v === null) continue;
      other.springs ??= Promise.all(Object.values(other.frames.head.springs.kinds).map(async (section) => ({
        columns: other.frames.head.sections[section].columns, vertices: await other.frames.array(section) })));
      const kinds = await other.springs;
      if (this.pickTurn !== turn || this.disposed) return;
      other.picked.set(v, t, springsOf(other.mesh, kinds, v));
    }
    this.draw();
    this.#showPicked();
  }

  /** Picks by number: in the view that has the focus, else in the first view. */
  pickNumber(kind, index) {
    const view = this.focused ?? this.views[0];
    if (!view) return;
    const count = kind === "vertex" ? view.mesh.vertexCount : view.mesh.triangleCount;
    const at = Math.min(Math.max(Math.round(index) || 0, 0), count - 1);
    if (kind === "vertex") this.pick(view, at, view.mesh.around.list[view.mesh.around.first[at]] ?? null);
    else this.pick(view, view.mesh.triangles[3 * at], at);
  }

  askFor(kind) {
    if (!this.hasPick()) this.pickNumber(kind, 0);
    this.#showPicked();
    this.controls.panel[kind].focus();
    this.controls.panel[kind].select();
  }

  hasPick() {
    return this.views.some((view) => view.picked.vertex !== null);
  }

  clearPick() {
    this.pickTurn = {};
    const inside = this.controls.panel.element.contains(document.activeElement);
    for (const view of this.views) view.picked.set(null, null, []);
    this.#showPicked();
    this.draw();
    if (inside) this.controls.cells[0].focus({ preventScroll: true });
  }

  #showPicked() {
    if (!this.hasPick() && this.controls.panel.element.hidden) return;
    const { reference } = this;
    const rows = [];
    const at = (key, view, kind) => {
      const found = this.compare.values(key, view, reference);
      if (!found) return NaN;
      return found.values[found.smooth ? view.picked.vertex : view.picked.triangle] ?? NaN;
    };
    if (reference) rows.push({ of: "vertex", name: `distance to ${reference.run.label} (m)`, text: (view) =>
      view === reference ? "–" : number(at("distance", view), 4) });
    for (const key of ["strain", "quality", "bending"]) {
      const quantity = this.compare.quantity(key, null);
      rows.push({ of: "triangle", name: `${quantity.name.toLowerCase()} ${quantity.symbol}`, text: (view) =>
        withUnit(this.compare.values(key, view, null).values[view.picked.triangle] ?? NaN, quantity.unit, 4) });
    }
    const stated = this.views.some((view) => view.frames.head.rigidity);
    if (stated) rows.push({ of: "triangle", name: "bending energy as stated (J/m²)", text: (view) =>
      number((view.frames.head.rigidity ?? NaN) *
        (this.compare.values("bending", view, null).values[view.picked.triangle] ?? NaN), 3) });
    this.controls.panel.show(this.views, rows);
  }

  // --- saving and keys

  saveStill() {
    return this.recorder.still();
  }

  saveAnimation() {
    return this.recorder.animation();
  }

  showKeys() {
    this.controls.showKeys();
  }

  /** Frees all resources, also the graphics context. */
  dispose() {
    this.stop();
    clearTimeout(this.refining);
    this.disposed = true;
    this.turn = null;
    this.resizes.disconnect();
    this.theme.removeEventListener("change", this.#restyled);
    this.print.removeEventListener("change", this.#printed);
    this.#dropViews();
    for (const texture of Object.values(this.textures ?? {})) texture.dispose();
    this.stage?.dispose();
    this.stage = null;
  }
}
