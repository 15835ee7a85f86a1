/** A chart of curves over a number, or of points beside the names of categories. Points may have a range. */
import { line } from "d3-shape";
import { button, html, svg } from "../page/dom.js";
import { titled } from "../page/numbers.js";
import { isChosen, whenChosen } from "../page/selection.js";
import { bottomAxis, leftAxis, LETTER, LINE, topAxis, wrapped, written } from "./axes.js";
import { followPlayer } from "./clock.js";
import { choice, takeAway, toggle } from "./controls.js";
import { Legend } from "./legend.js";
import { mark, paint } from "./look.js";
import { Pointing } from "./pointing.js";
import { shownPoints } from "./points.js";
import { axisScale, extent, LEAST_WIDTH, NARROW } from "./scales.js";

const TALL = 430; // px. A taller chart has an axis above the plot, too, so that a screen shows an axis.
const FAR = 80; // px; a name farther from the end of its curve has no line to the curve

let made = 0;

export class LineChart {
  /** @param {HTMLElement} figure @param {Object} chart as in the page's data */
  constructor(figure, chart) {
    this.figure = figure;
    this.chart = chart;
    this.id = `chart-${++made}`;
    this.bands = chart.x.scale === "band";
    this.state = {
      metric: chart.choice ?? 0,
      held: (chart.held ?? []).map((axis) => axis.at),
      zoom: null,
      log: false,
    };
    this.#build();
    this.#startLog();
    this.resizes = new ResizeObserver(() => this.draw());
    this.resizes.observe(this.plot);
  }

  /** Ends what would keep the chart alive after its figure has another chart. */
  dispose() {
    this.resizes.disconnect();
    this.ignoreChosen();
  }

  get y() {
    return this.chart.ys[this.state.metric];
  }

  /** Draws the chart again with other data, for example with more points. */
  replace(chart) {
    Object.assign(this.chart, chart);
    this.draw();
  }

  #build() {
    const { chart, state } = this;
    const entries = new Map(chart.series.map((series) => [series.label, series]));
    this.legend = new Legend(
      [...entries.values()],
      this.bands ? "mark" : "line",
      () => this.draw(),
      (label) => this.#highlight(label),
    );
    this.log = toggle(
      "Log",
      false,
      (on) => {
        state.log = on;
        this.draw();
      },
      "Logarithmic axis of the values",
    );
    this.reset = button("Reset zoom", () => this.zoom(null), { hidden: true });
    const tools = html(
      "div",
      { class: "tools" },
      chart.ys.length > 1 &&
        choice(
          "Show",
          chart.ys.map((y) => y.label),
          state.metric,
          (metric) => {
            state.metric = metric;
            this.#startLog();
            this.draw();
          },
        ),
      ...(chart.held ?? []).map((axis, i) =>
        choice(axis.label, axis.values, axis.at, (at) => {
          state.held[i] = at;
          this.draw();
        }),
      ),
      this.reset,
      this.log,
      takeAway(chart),
    );
    const opens = chart.series.some(({ run, runs }) => run || runs?.some((ids) => ids.length));
    const keys = `point to point${opens ? ", Enter opens the run" : ""}${this.bands ? "" : ", + and - zoom"}`;
    this.plot = html("div", {
      class: "plot",
      tabindex: 0,
      role: "group",
      "aria-roledescription": "chart",
      "aria-label": `${chart.title}. Arrow keys go from ${keys}.`,
    });
    this.meaning = html("p", { class: "meaning" });
    this.body = html(
      "div",
      { class: "chart-body" },
      entries.size > 1 && chart.legend !== false && this.legend.element,
      this.plot,
    );
    this.figure.append(tools, this.body, this.meaning);
    this.pointing = new Pointing(this);
    this.ignoreChosen = whenChosen(() => this.#markChosen());
    if (chart.x.name === "time") followPlayer(this.figure, (time) => this.#markTime(time));
  }

  // Starts with the axis that the chart states, logarithmic or linear. If the chart states none, the axis is
  // logarithmic if the numbers differ widely.
  #startLog() {
    const all = shownPoints(this.chart, { ...this.state, hidden: new Set() })
      .flatMap(({ points }) => points.map((p) => p.y))
      .filter(Number.isFinite)
      .sort((a, b) => a - b);
    const able = all.length > 0 && all[0] >= 0 && all.at(-1) > 0;
    const share = (part) => all[Math.round(part * (all.length - 1))];
    this.log.disabled = !able;
    const least = share(all.length < 20 ? 0 : 0.05);
    const { y_scale: stated } = this.chart;
    this.state.log = able && (stated ? stated === "log" : least > 0 && share(1) / least > 30);
    this.log.setAttribute("aria-pressed", this.state.log);
  }

  draw() {
    const width = this.paper ?? this.plot.clientWidth;
    if (width < LEAST_WIDTH) return;
    const { chart } = this;
    this.above = this.bands && width < NARROW;
    this.shown = shownPoints(chart, { ...this.state, hidden: this.legend.hidden });
    this.meaning.textContent = this.y.meaning ?? "";
    this.#findNeighbours();
    const titles = [this.y, chart.x].map(({ label, unit }) =>
      wrapped(titled(label, unit), (width - 40) / LETTER),
    );
    if (this.bands) titles.reverse();
    const [upper, lower] = titles.map((lines) => LINE * (lines.length - 1)); // px of further lines
    const bare = this.#height(width),
      tall = this.bands && bare > TALL ? 36 + lower + (this.above ? LINE : 0) : 0; // px of the axis above
    const limits = this.#ownLimits();
    for (const limit of limits) limit.lines = wrapped(limit.text, width / LETTER / (this.bands ? 2 : 1));
    const said = this.bands ? LINE * Math.max(0, ...limits.map(({ lines }) => lines.length - 1)) : 0;
    const height = bare + tall + upper + lower + said;
    const beside = !this.paper && this.#isBeside(width, height);
    const box = {
      left: this.above ? 8 : this.bands ? this.#categoryWidth(width) : 54,
      right: width - (beside ? this.legend.width + 34 : 0) - 14,
      top: 26 + upper + tall + said,
      bottom: height - 48 - lower,
    };
    this.#scales(box);
    this.picture = svg("svg", { class: "picture", width, height, viewBox: `0 0 ${width} ${height}` });
    const [lines, texts] = this.#limits(box);
    const [value, place] = [this.value, this.place];
    const axes = [
      leftAxis(this.bands ? place : value, box, titles[0], this.above),
      bottomAxis(this.bands ? value : place, box, titles[1], this.bands),
    ];
    if (this.bands) axes.reverse();
    this.picture.append(
      axes[0],
      ...lines, // over the grid, below the names of categories
      axes[1],
      ...(tall ? [topAxis(value, box, titles[1], box.top - said - 20)] : []),
      ...this.#series(box),
      ...texts,
    );
    if (!this.shown.length) {
      this.picture.append(
        svg(
          "text",
          {
            class: "empty",
            x: (box.left + box.right) / 2,
            y: (box.top + box.bottom) / 2,
            "text-anchor": "middle",
          },
          "No run has this metric",
        ),
      );
    }
    this.plot.replaceChildren(this.picture);
    this.box = box;
    this.pointing.renew();
    this.#markChosen();
    if (beside) this.#namesBeside(box);
    else this.legend.flow();
  }

  #height(width) {
    if (!this.bands) return Math.max(300, Math.min(430, width * 0.5));
    const row = Math.max(27, 14 + this.#dodged() * (this.#hasRanges() ? 13 : 6)) + (this.above ? LINE : 0);
    return Math.max(150, 74 + this.#categories().length * row);
  }

  #isBeside(width, height) {
    return (
      !this.bands &&
      this.chart.legend !== false &&
      width >= 620 &&
      this.legend.buttons.size > 1 &&
      this.legend.width + 34 <= 0.32 * width &&
      this.legend.fits(height - 74)
    );
  }

  // The indices of the categories to show: all, or in a chart with `held` axes the categories with points.
  #categories() {
    const all = this.chart.x.categories.map((_, i) => i);
    if (!this.chart.held?.length) return all;
    const used = new Set(this.shown.flatMap(({ points }) => points.map((p) => p.x)));
    return used.size ? all.filter((i) => used.has(i)) : all;
  }

  #categoryWidth(width) {
    const texts = this.#categories().map((i) => String(this.chart.x.categories[i]));
    const longest = Math.max(...texts.map((text) => text.length));
    return Math.min(longest * 7.8 + 16, width * 0.42);
  }

  // Finds the series with points at each category. Their points are drawn side by side.
  #findNeighbours() {
    this.neighbours = new Map();
    if (this.chart.dodge === false) return;
    this.shown.forEach(({ points }, i) => {
      for (const { x } of points) {
        const all = this.neighbours.get(x) ?? [];
        if (!all.includes(i)) all.push(i);
        this.neighbours.set(x, all);
      }
    });
  }

  // The largest number of series whose points are drawn side by side at a category.
  #dodged() {
    return Math.max(1, ...[...this.neighbours.values()].map((all) => all.length));
  }

  #scales(box) {
    const { chart, state } = this;
    const everything = this.shown.flatMap(({ points }) => points);
    const values = everything.filter((p) => this.#isInside(p)).flatMap((p) => [p.y, p.low, p.high]);
    const data = [...values];
    for (const limit of this.#ownLimits()) {
      limit.near = this.#isNear(limit, data);
      if (limit.near) values.push(limit.value);
    }
    const across = this.bands ? [box.left, box.right] : [box.bottom, box.top];
    this.value = axisScale(
      state.log ? "log" : "linear",
      extent(values, state.log),
      across,
      null,
      this.bands ? 80 : 46,
    );
    if (this.bands) {
      this.place = axisScale(
        "band",
        this.#categories(),
        [box.top, box.bottom],
      );
      const room = (this.above ? box.right : box.left) / 6.9;
      this.place.text = (i) => shortened(chart.x.categories[i], room);
      return;
    }
    const kind = chart.x.scale,
      logarithmic = kind !== "linear";
    const xs = chart.series.flatMap((series) => series.x);
    const domain =
      state.zoom ??
      (chart.x.name === "time" ? [Math.min(...xs), Math.max(...xs)] : extent(xs, logarithmic, 0.05, false));
    this.place = axisScale(
      kind,
      domain[0] < domain[1] ? domain : extent(xs, logarithmic, 0.05, false),
      [box.left, box.right],
      chart.x.ticks,
    );
  }

  #isInside({ x }) {
    const { zoom } = this.state;
    return !zoom || (x >= zoom[0] && x <= zoom[1]);
  }

  #ownLimits() {
    const all = (this.chart.limits ?? []).filter((limit) => limit.metric === this.y.name);
    return all.filter((limit) => !this.state.log || limit.value > 0);
  }

  // Whether a limit is drawn as a line. A limit far from the numbers would flatten the curves, so only the
  // text of the limit is drawn, at the edge.
  #isNear(limit, values) {
    const numbers = values
      .filter(Number.isFinite)
      .map((y) => (this.state.log ? Math.log(Math.max(y, 1e-300)) : y));
    const at = this.state.log ? Math.log(limit.value) : limit.value;
    const low = Math.min(...numbers),
      high = Math.max(...numbers),
      room = 1.5 * (high - low) || Math.abs(high) / 2;
    return at <= high + room && at >= low - room;
  }

  // The lines and the texts of limits. Texts are drawn after the curves, which would hide them.
  #limits(box) {
    let edge = 0;
    const lines = [],
      texts = [];
    const write = (said, x, y, anchor) =>
      texts.push(...written(said, { class: "limit", x, y, "text-anchor": anchor }));
    for (const limit of this.#ownLimits()) {
      const at = this.value.scale(limit.value);
      if (!limit.near) {
        const over = limit.value > this.value.scale.domain()[1];
        const arrow = ` ${this.#arrows[Number(over)]}`;
        const y = over ? box.top - 8 + 15 * edge++ : box.bottom - 7;
        write(limit.lines.with(-1, limit.lines.at(-1) + arrow), box.right, y, "end");
        continue;
      }
      const d = this.bands ? `M${at} ${box.top}V${box.bottom}` : `M${box.left} ${at}H${box.right}`;
      lines.push(svg("path", { class: "limit", d }));
      if (!this.bands) write(limit.lines, box.right, at - 5, "end");
      else if (2 * at > box.left + box.right) write(limit.lines, at - 4, box.top - 6, "end");
      else write(limit.lines, at + 4, box.top - 6, "start");
    }
    return [lines, texts];
  }

  // The arrows towards numbers that are below and above the axis of the values.
  get #arrows() {
    return this.bands ? ["←", "→"] : ["↓", "↑"];
  }

  #series(box) {
    const { chart } = this;
    const clip = `${this.id}-clip`;
    const area = svg("rect", {
      x: box.left - 6,
      y: box.top - 6,
      width: box.right - box.left + 12,
      height: box.bottom - box.top + 12,
    });
    const drawn = this.shown.map((entry, i) => {
      for (const p of entry.points) this.#put(p, i, box);
      const group = paint(svg("g", { class: "series", "clip-path": `url(#${clip})` }), entry.series.look);
      const { line } = entry.series; // a curve of theory has no marks
      if (!this.bands && (line || chart.joined !== false)) group.append(this.#curve(entry));
      if (!line) group.append(...this.#ranges(entry), ...this.#marks(entry));
      entry.drawn = group;
      return group;
    });
    return [svg("clipPath", { id: clip }, area), ...drawn];
  }

  // Sets the position of a point in pixels. A value that the axis cannot show, because it is infinite or too
  // small for a logarithm, is an arrow at the edge.
  #put(p, i, box) {
    const edges = this.bands ? [box.left, box.right] : [box.bottom, box.top];
    // Outside a zoomed part, smaller values have places below the axis, so that their curves are not broken.
    const least = this.#isInside(p) ? this.value.scale.domain()[0] : 0;
    const beyond = (v) => (v === Infinity ? 1 : v === -Infinity || (this.state.log && v <= least) ? 0 : null);
    const across = (v) => (beyond(v) === null ? this.value.scale(v) : edges[beyond(v)]);
    p.arrow = this.#arrows[beyond(p.y)];
    p.ends = [p.low, p.high].map((v) => beyond(v) === null);
    const beside = (this.bands ? this.neighbours.get(p.x) : [...this.shown.keys()]) ?? [];
    const many = beside.length;
    const aside =
      this.chart.dodge === false || many < 2
        ? 0
        : (beside.indexOf(i) - (many - 1) / 2) *
          (this.bands
            ? Math.min(this.#hasRanges() ? 13 : 6, 40 / many)
            : this.#hasRanges()
              ? Math.min(4, 24 / many)
              : 0);
    const along = this.place.scale(p.x) + aside;
    const at = (v) => (this.bands ? [across(v), along] : [along, across(v)]);
    p.at = at(p.y);
    p.from = at(p.low);
    p.to = at(p.high);
  }

  #hasRanges() {
    return this.shown.some(({ points }) => points.some((p) => p.low !== p.high));
  }

  #curve({ series, points }) {
    const path = line()
      .x((p) => p.at[0])
      .y((p) => p.at[1])
      .defined((p) => !p.arrow);
    return svg("path", { class: "line", d: path(points) ?? "", "stroke-dasharray": series.look.dash });
  }

  #ranges({ points }) {
    const cap = (at) => (this.bands ? `M${at[0]} ${at[1] - 3.5}v7` : `M${at[0] - 3.5} ${at[1]}h7`);
    return points
      .filter((p) => p.low !== p.high)
      .map((p) =>
        svg("path", {
          class: "range",
          d: `M${p.from}L${p.to}${p.ends[0] ? cap(p.from) : ""}${p.ends[1] ? cap(p.to) : ""}`,
        }),
      );
  }

  // If a curve has many points, only about nine of the points have a mark.
  #marks({ series, points }) {
    const joined = !this.bands && this.chart.joined !== false;
    const every = joined && points.length > 45 ? Math.ceil(points.length / 9) : 1;
    return points
      .filter((_, i) => i % every === 0)
      .map((p) => {
        const transform = `translate(${p.at}) rotate(${90 * "↓←↑→".indexOf(p.arrow)})`;
        p.drawn = p.arrow
          ? svg("path", { class: "beyond", d: "M0-10V0M-3.5-4L0 0L3.5-4", transform })
          : mark(series.look, ...p.at);
        return p.drawn;
      });
  }

  // Points and curves of runs that are not chosen are pale.
  #markChosen() {
    for (const { drawn, points } of this.shown ?? []) {
      for (const p of points) p.drawn?.classList.toggle("off", !isChosen(p.runs));
      drawn?.classList.toggle("off", points.every((p) => !isChosen(p.runs)));
    }
  }

  #namesBeside(box) {
    const ends = new Map();
    for (const { series, points } of this.shown) {
      const seen = points.filter((p) => p.at[0] <= box.right + 1 && p.at[0] >= box.left - 1);
      if (seen.length) ends.set(series.label, seen.at(-1).at);
    }
    const left = box.right + 26;
    const heights = new Map(
      [...ends].map(([label, at]) => [label, Math.min(Math.max(at[1], box.top), box.bottom)]),
    );
    const placed = this.legend.beside(heights, left, box.top, box.bottom);
    for (const { series } of this.shown) {
      const end = ends.get(series.label);
      if (!end || (this.chart.joined === false && !series.line)) continue;
      const from = heights.get(series.label),
        to = placed.get(series.label);
      if (Math.max(box.right - end[0], Math.abs(from - to)) > FAR) continue; // a long line looks like data
      this.picture.append(
        paint(
          svg("path", {
            class: "leader",
            d: `M${end[0] + 7} ${from}L${left - 3} ${to}`,
          }),
          series.look,
        ),
      );
    }
  }

  #highlight(label) {
    for (const { series, drawn } of this.shown ?? [])
      drawn?.classList.toggle(
        "dim",
        label !== null && label !== series.label && !this.legend.hidden.has(label),
      );
  }

  /** Shows the part of the axis between two ends; null: the whole axis. */
  zoom(ends) {
    if (this.bands) return;
    this.state.zoom = ends;
    this.reset.hidden = !ends;
    this.draw();
  }

  #markTime(time) {
    if (!this.picture || !this.box) return;
    this.clock?.remove();
    const x = this.place.scale(time);
    if (!(x >= this.box.left && x <= this.box.right)) return;
    this.clock = svg("path", { class: "clock", d: `M${x} ${this.box.top}V${this.box.bottom}` });
    this.picture.append(this.clock);
  }
}

function shortened(text, room) {
  const all = String(text);
  return all.length > room ? `${all.slice(0, Math.max(3, Math.floor(room) - 1))}…` : all;
}
