/** Parallel coordinates: an upright line for each dimension, a curve for each run. Dragging along a part of a
 * line chooses the runs whose curves cross this part. */
import { line } from "d3-shape";
import { axisScale, extent } from "../charts/scales.js";
import { paint } from "../charts/look.js";
import { html, svg } from "../page/dom.js";
import { titled } from "../page/numbers.js";

const GAP = 104; // px, smallest distance of two lines
const TOP = 46,
  BOTTOM = 18,
  HEIGHT = 330,
  SIDE = 64,
  NAMES = 110, // px left of the first line
  CLICK = 4; // px; a shorter drag is a click

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
    for (const name of this.ranges.keys())
      if (!dimensions.some((each) => each.name === name)) this.ranges.delete(name);
    this.#draw();
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
    const picture = svg("svg", { class: "picture", width, height: HEIGHT, viewBox: `0 0 ${width} ${HEIGHT}` });
    this.curves = this.runs.map((run) => ({ run, path: this.#curve(run) })).filter(({ path }) => path);
    picture.append(svg("g", {}, ...this.curves.map(({ path }) => path)));
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

  #line({ dimension, x, ticks, text }, gap) {
    const label = wrapped(titled(dimension.label, dimension.unit), Math.max(gap, GAP) / 6.6);
    const group = svg(
      "g",
      { class: "axis" },
      svg("path", { class: "base", d: `M${x} ${TOP}V${HEIGHT - BOTTOM}` }),
      ...label.map((part, i) =>
        svg("text", { class: "title", x, y: TOP - 18 + 14 * (i + 1 - label.length), "text-anchor": "middle" }, part),
      ),
      ...ticks.map(({ y, value }) => svg("text", { x: x - 6, y: y + 4, "text-anchor": "end" }, text(value))),
    );
    const handle = svg("rect", {
      class: "handle",
      x: x - 14,
      y: TOP - 8,
      width: 28,
      height: HEIGHT - TOP - BOTTOM + 16,
    });
    const range = this.ranges.get(dimension.name);
    const brush = svg("rect", { class: "brush", x: x - 8, width: 16, y: 0, height: 0 });
    if (range) place(brush, range);
    group.append(brush, handle);
    this.#follow(handle, brush, dimension);
    return group;
  }

  #follow(handle, brush, dimension) {
    let from = null;
    const at = (event) => {
      const box = handle.ownerSVGElement.getBoundingClientRect();
      return Math.min(Math.max(event.clientY - box.top, TOP - 8), HEIGHT - BOTTOM + 8);
    };
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
      from = at(event);
    });
    handle.addEventListener("pointermove", (event) => {
      if (from !== null) place(brush, [Math.min(from, at(event)), Math.max(from, at(event))]);
    });
    handle.addEventListener("pointerup", (event) => {
      const ends = [Math.min(from, at(event)), Math.max(from, at(event))];
      from = null;
      if (ends[1] - ends[0] < CLICK) {
        this.ranges.delete(dimension.name);
        place(brush, [0, 0]);
      } else this.ranges.set(dimension.name, ends);
      this.changed();
    });
  }
}

function place(brush, [low, high]) {
  brush.setAttribute("y", low);
  brush.setAttribute("height", high - low);
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

function wrapped(text, most) {
  const lines = [""];
  for (const word of text.split(" "))
    if (lines.at(-1) && lines.at(-1).length + word.length >= most) lines.push(word);
    else lines[lines.length - 1] += (lines.at(-1) ? " " : "") + word;
  return lines.slice(0, 2);
}
