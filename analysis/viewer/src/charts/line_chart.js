/** A chart of curves over a number, or of points beside the names of categories. Points may have a range. */
import { line } from "d3-shape";
import { button, html, svg } from "../page/dom.js";
import { titled } from "../page/numbers.js";
import { isChosen, whenChosen } from "../page/selection.js";
import { bottomAxis, leftAxis, topAxis } from "./axes.js";
import { followPlayer } from "./clock.js";
import { choice, takeAway, toggle } from "./controls.js";
import { Legend } from "./legend.js";
import { mark, paint } from "./look.js";
import { Pointing } from "./pointing.js";
import { shownPoints } from "./points.js";
import { axisScale, extent, LEAST_WIDTH } from "./scales.js";

const TALL = 430; // px. A taller chart has an axis above the plot, too, so that a screen shows an axis.

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
    new ResizeObserver(() => this.draw()).observe(this.plot);
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
    this.plot = html("div", {
      class: "plot",
      tabindex: 0,
      role: "group",
      "aria-roledescription": "chart",
      "aria-label": `${chart.title}. Arrow keys go from point to point, Enter opens the run, + and - zoom.`,
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
    whenChosen(() => this.#markChosen());
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
    const wanted = this.chart.y_scale ? this.chart.y_scale === "log" : share(1) / least > 30;
    this.state.log = able && least > 0 && wanted;
    this.log.setAttribute("aria-pressed", this.state.log);
  }

  draw() {
    const width = this.plot.clientWidth;
    if (width < LEAST_WIDTH) return;
    const { chart } = this;
    this.shown = shownPoints(chart, { ...this.state, hidden: this.legend.hidden });
    this.meaning.textContent = this.y.meaning ?? "";
    this.#findNeighbours();
    const height = this.#height(width);
    const beside = this.#isBeside(width, height);
    const names = beside ? Math.min(this.legend.width + 34, width * 0.32) : 0;
    const box = {
      left: this.bands ? this.#categoryWidth(width) : 54,
      right: width - names - 14,
      top: this.bands && height > TALL ? 62 : 26,
      bottom: height - 48,
    };
    this.#scales(box);
    this.picture = svg("svg", { class: "picture", width, height, viewBox: `0 0 ${width} ${height}` });
    this.picture.append(...this.#axes(box), ...this.#limits(box), this.#series(box));
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
    const row = Math.max(27, 14 + this.#dodged() * (this.#hasRanges() ? 13 : 6));
    const bare = Math.max(150, 74 + this.#categories().length * row);
    return bare > TALL ? bare + 36 : bare;
  }

  #isBeside(width, height) {
    return (
      !this.bands &&
      this.chart.legend !== false &&
      width >= 620 &&
      this.legend.buttons.size > 1 &&
      this.legend.fits(height - 74)
    );
  }

  // The indices of the categories to show: all, or in a chart with `held` axes the categories with points.
  #categories() {
    const all = this.chart.x.categories.map((_, i) => i);
    if (!this.chart.held?.length) return all;
    const used = new Set(this.shown.flatMap(({ points }) => points.map((p) => p.x)));
    return all.filter((i) => used.has(i));
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
    const inside = ({ x }) => !state.zoom || (x >= state.zoom[0] && x <= state.zoom[1]);
    const values = everything.filter(inside).flatMap((p) => [p.y, p.low, p.high]);
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
      this.place.text = (i) => shortened(chart.x.categories[i], box.left / 6.9);
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

  #axes(box) {
    const { chart, y } = this;
    const values = titled(y.label, y.unit),
      places = titled(chart.x.label, chart.x.unit);
    if (this.bands) {
      const across = [leftAxis(this.place, box, places), bottomAxis(this.value, box, values, true)];
      return box.top > 40 ? [...across, topAxis(this.value, box, values)] : across;
    }
    return [leftAxis(this.value, box, values), bottomAxis(this.place, box, places, false)];
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

  #limits(box) {
    let edge = 0;
    return this.#ownLimits().map((limit) => {
      if (!limit.near) {
        const over = limit.value > this.value.scale.domain()[1];
        const y = over ? box.top - 8 + 15 * edge++ : box.bottom - 7;
        const arrow = this.bands ? (over ? " →" : " ←") : over ? " ↑" : " ↓";
        return svg(
          "g",
          { class: "limit" },
          svg("text", { x: box.right, y, "text-anchor": "end" }, limit.text + arrow),
        );
      }
      const at = this.value.scale(limit.value);
      const d = this.bands ? `M${at} ${box.top}V${box.bottom}` : `M${box.left} ${at}H${box.right}`;
      const text = this.bands
        ? svg("text", { x: at + 4, y: box.top - 6 }, limit.text)
        : svg("text", { x: box.right, y: at - 5, "text-anchor": "end" }, limit.text);
      return svg("g", { class: "limit" }, svg("path", { d }), text);
    });
  }

  #series(box) {
    const { chart } = this;
    const clip = `${this.id}-clip`;
    const group = svg(
      "g",
      { class: "all-series" },
      svg(
        "clipPath",
        { id: clip },
        svg("rect", {
          x: box.left - 6,
          y: box.top - 6,
          width: box.right - box.left + 12,
          height: box.bottom - box.top + 12,
        }),
      ),
    );
    this.shown.forEach((entry, i) => {
      for (const p of entry.points) this.#put(p, i, box);
      const drawn = paint(svg("g", { class: "series", "clip-path": `url(#${clip})` }), entry.series.look);
      const { line } = entry.series; // a curve of theory has no marks
      if (!this.bands && (line || chart.joined !== false)) drawn.append(this.#curve(entry));
      if (!line) drawn.append(...this.#ranges(entry), ...this.#marks(entry));
      entry.drawn = drawn;
      group.append(drawn);
    });
    return group;
  }

  // Sets the position of a point in pixels. A point with an infinite value is at the edge.
  #put(p, i, box) {
    const far = this.bands ? box.right : box.top;
    const least = this.value.scale.domain()[0];
    const across = (v) =>
      Number.isFinite(v) && !(this.state.log && v <= least)
        ? this.value.scale(v)
        : v > least
          ? far
          : this.bands
            ? box.left
            : box.bottom;
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
      .defined((p) => Number.isFinite(p.y));
    return svg("path", { class: "line", d: path(points) ?? "", "stroke-dasharray": series.look.dash });
  }

  #ranges({ points }) {
    const cap = (at) => (this.bands ? `M${at[0]} ${at[1] - 3.5}v7` : `M${at[0] - 3.5} ${at[1]}h7`);
    return points
      .filter((p) => p.low !== p.high)
      .map((p) =>
        svg("path", {
          class: "range",
          d: `M${p.from[0]} ${p.from[1]}L${p.to[0]} ${p.to[1]}${cap(p.from)}${cap(p.to)}`,
        }),
      );
  }

  // If a curve has many points, only about nine of the points have a mark.
  #marks({ series, points }) {
    const every = points.length > 45 ? Math.ceil(points.length / 9) : 1;
    return points
      .filter((_, i) => i % every === 0 || (i === points.length - 1 && every === 1))
      .map((p) => {
        p.drawn = Number.isFinite(p.y)
          ? mark(series.look, ...p.at)
          : svg("text", { class: "lost", x: p.at[0], y: p.at[1] + 9, "text-anchor": "middle" }, "↑");
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
    for (const { series, drawn } of this.shown) {
      const end = ends.get(series.label);
      if (!end) continue;
      this.picture.append(
        paint(
          svg("path", {
            class: "leader",
            d: `M${end[0] + 7} ${heights.get(series.label)}L${left - 3} ${placed.get(series.label)}`,
          }),
          series.look,
        ),
      );
      drawn.dataset.label = series.label;
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
