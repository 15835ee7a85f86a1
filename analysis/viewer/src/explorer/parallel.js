/** Parallel coordinates: an upright line for each dimension, a curve for each run. Dragging along a part of a
 * line, or arrow keys, choose the runs whose curves cross this part. */
import { line } from "d3-shape";
import { wrapped, written } from "../charts/axes.js";
import { axisScale, extent } from "../charts/scales.js";
import { paint } from "../charts/look.js";
import { html, svg } from "../page/dom.js";
import { number, titled } from "../page/numbers.js";

const GAP = 104; // px, smallest distance of two lines
const TOP = 46,
  BOTTOM = 18,
  HEIGHT = 330,
  SIDE = 64,
  NAMES = 110, // px left of the first line
  CLICK = 4; // px; a shorter drag is a click
// By how many runs a key moves the upper and the lower end of the chosen part.
const MOVES = {
  ArrowUp: [-1, 0],
  ArrowDown: [1, 0],
  ArrowRight: [0, -1],
  ArrowLeft: [0, 1],
  Delete: [-Infinity, Infinity],
};

export class Parallel {
  /**
   * @param {(id: string) => void} open a run
   * @param {() => void} changed called after the choice of runs has changed
   */
  constructor(open, changed) {
    this.open = open;
    this.changed = changed;
    this.ranges = new Map(); // name of a dimension → [low, high] in px from its top
    this.element = html("div", { class: "scroll parallel" });
    new ResizeObserver(() => this.#draw()).observe(this.element);
  }

  /** @param {import("./dimensions.js").Dimension[]} dimensions @param {Object[]} runs
   * @param {(run: Object) => Object} lookOf */
  show(dimensions, runs, lookOf) {
    Object.assign(this, { dimensions, runs, lookOf });
    const dropped = [...this.ranges.keys()].filter((name) => !dimensions.some((each) => each.name === name));
    for (const name of dropped) this.ranges.delete(name);
    this.#draw();
    if (dropped.length) this.changed();
  }

  /** The ids of the runs that are inside the dragged range of every line; null without a dragged range. */
  get inside() {
    if (!this.ranges.size) return null;
    const within = (run) =>
      this.lines.every(({ dimension, scale }) => {
        const range = this.ranges.get(dimension.name);
        const y = scale(dimension.of(run));
        return !range || (y >= range[0] && y <= range[1]);
      });
    return this.runs.filter(within).map((run) => run.id);
  }

  clear() {
    this.ranges.clear();
    this.#draw();
  }

  /** Shows which runs are chosen. @param {(id: string) => boolean} isChosen */
  mark(isChosen) {
    this.isChosen = isChosen;
    for (const { run, path } of this.curves ?? []) path.classList.toggle("off", !isChosen(run.id));
  }

  #draw() {
    const { dimensions } = this;
    if (!dimensions?.length || !this.element.clientWidth) return;
    const sides = NAMES + SIDE,
      least = sides + GAP * (dimensions.length - 1);
    const width = Math.max(this.element.clientWidth - 2, least);
    const gap = dimensions.length > 1 ? (width - sides) / (dimensions.length - 1) : 0;
    this.lines = dimensions.map((dimension, i) => ({
      dimension,
      x: NAMES + i * gap,
      ...scaleOf(dimension, this.runs),
    }));
    const picture = svg("svg", {
      class: "picture",
      width,
      height: HEIGHT,
      viewBox: `0 0 ${width} ${HEIGHT}`,
      role: "group",
      "aria-label":
        "A line for each setting and number, a curve for each run. On a line, up and down move the upper " +
        "end of the chosen part, right and left its lower end, Delete chooses all.",
    });
    this.curves = this.runs.map((run) => ({ run, path: this.#curve(run) })).filter(({ path }) => path);
    picture.append(svg("g", { "aria-hidden": "true" }, ...this.curves.map(({ path }) => path)));
    picture.append(...this.lines.map((each) => this.#line(each, gap)));
    this.element.replaceChildren(picture);
    if (this.isChosen) this.mark(this.isChosen);
  }

  #curve(run) {
    const places = this.lines.map(({ x, scale, dimension }) => [x, scale(dimension.of(run))]);
    const d = line().defined(([, y]) => Number.isFinite(y))(places);
    if (!d) return null;
    const path = svg("path", { class: "line run-line", d }, svg("title", {}, run.title ?? run.label));
    path.addEventListener("click", () => this.open(run.id));
    return paint(path, this.lookOf(run));
  }

  #line(own, gap) {
    const { dimension, x, ticks, text } = own;
    const title = titled(dimension.label, dimension.unit);
    const label = wrapped(title, Math.max(gap, GAP) / 6.6).slice(0, 2);
    const axis = svg(
      "g",
      { class: "axis", "aria-hidden": "true" },
      svg("path", { class: "base", d: `M${x} ${TOP}V${HEIGHT - BOTTOM}` }),
      ...written(label, { class: "title", x, y: TOP - 18, "text-anchor": "middle" }),
      ...ticks.map(({ y, value }) => svg("text", { x: x - 6, y: y + 4, "text-anchor": "end" }, text(value))),
    );
    own.handle = svg("rect", {
      class: "handle",
      x: x - 14,
      y: TOP - 8,
      width: 28,
      height: HEIGHT - TOP - BOTTOM + 16,
      tabindex: 0,
      role: "slider",
      "aria-label": title,
      "aria-orientation": "vertical",
    });
    own.brush = svg("rect", { class: "brush", x: x - 8, width: 16 });
    this.#tell(own);
    this.#follow(own);
    return svg("g", {}, axis, own.brush, own.handle);
  }

  // The heights of the runs on a line, from above, and the first and last of them in the chosen part.
  #heights({ dimension, scale }) {
    const all = [...new Set(this.runs.map((run) => scale(dimension.of(run))))].filter(Number.isFinite);
    all.sort((a, b) => a - b);
    const [low, high] = this.ranges.get(dimension.name) ?? [-Infinity, Infinity];
    return { all, upper: all.findIndex((y) => y >= low), lower: all.findLastIndex((y) => y <= high) };
  }

  // Shows the chosen part of a line, and tells it to screen readers.
  #tell(own) {
    const { dimension, scale, handle, brush } = own;
    const range = this.ranges.get(dimension.name);
    place(brush, range ?? [0, 0]);
    const within = (x) => !range || (scale(x) >= range[0] && scale(x) <= range[1]);
    const values = this.runs.map(dimension.of).filter((x) => !Number.isNaN(x) && within(x));
    const text = (x) => (dimension.scale === "band" ? dimension.texts[x] : number(x));
    const ends = values.length ? `${text(Math.min(...values))} to ${text(Math.max(...values))}` : "no run";
    const { all, upper } = this.#heights(own);
    handle.setAttribute("aria-valuetext", range ? ends : `all, ${ends}`);
    handle.setAttribute("aria-valuemax", all.length - 1);
    handle.setAttribute("aria-valuenow", all.length - 1 - upper);
  }

  #choose(own, range) {
    if (range) this.ranges.set(own.dimension.name, range);
    else this.ranges.delete(own.dimension.name);
    this.#tell(own);
    this.changed();
  }

  // Moves an end of the chosen part to the next run.
  #key(own, event) {
    const { all, upper, lower } = this.#heights(own);
    const moves = MOVES[event.key];
    if (!moves || !all.length) return;
    event.preventDefault();
    const last = all.length - 1;
    const empty = upper < 0 || upper > lower; // no run is in the chosen part
    const [first, end] = empty ? [0, last] : [upper, lower];
    const from = Math.min(Math.max(first + moves[0], 0), end),
      to = Math.min(Math.max(end + moves[1], first), last);
    this.#choose(own, from === 0 && to === last ? null : [all[from], all[to]]);
  }

  #follow(own) {
    const { handle, brush } = own;
    let from = null;
    const at = (event) => {
      const box = handle.ownerSVGElement.getBoundingClientRect();
      return Math.min(Math.max(event.clientY - box.top, TOP - 8), HEIGHT - BOTTOM + 8);
    };
    handle.addEventListener("keydown", (event) => this.#key(own, event));
    handle.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      handle.setPointerCapture(event.pointerId);
      from = at(event);
    });
    handle.addEventListener("pointermove", (event) => {
      if (from !== null) place(brush, [Math.min(from, at(event)), Math.max(from, at(event))]);
    });
    handle.addEventListener("pointercancel", () => {
      from = null;
      this.#tell(own);
    });
    handle.addEventListener("pointerup", (event) => {
      if (from === null) return;
      const ends = [Math.min(from, at(event)), Math.max(from, at(event))];
      from = null;
      this.#choose(own, ends[1] - ends[0] < CLICK ? null : ends);
    });
  }
}

function place(brush, [low, high]) {
  brush.setAttribute("y", low - 2);
  brush.setAttribute("height", high ? high - low + 4 : 0); // a part with a single height is seen, too
}

function scaleOf(dimension, runs) {
  const range = [HEIGHT - BOTTOM, TOP];
  if (dimension.scale === "band") {
    const { scale } = axisScale("band", dimension.texts.map((_, i) => i), range.toReversed());
    return {
      scale: (at) => scale(at) ?? NaN,
      ticks: dimension.texts.map((_, i) => ({ value: i, y: scale(i) })),
      text: (i) => cut(dimension.texts[i], 16),
    };
  }
  const logarithmic = dimension.scale === "log";
  const domain = extent(runs.map(dimension.of), logarithmic, 0.02, false);
  const own = axisScale(dimension.scale, domain, range, dimension.numbers, 40);
  const far = (x) => {
    if (Number.isNaN(x)) return NaN;
    const y = x === Infinity ? TOP - 6 : logarithmic && x <= 0 ? Infinity : own.scale(x);
    return Math.min(Math.max(y, TOP - 6), HEIGHT - BOTTOM + 6); // numbers beyond the axis are put at its end
  };
  return { scale: far, ticks: own.ticks.map((value) => ({ value, y: own.scale(value) })), text: own.text };
}

const cut = (text, most) => (text.length > most ? `${text.slice(0, most - 1)}…` : text);
