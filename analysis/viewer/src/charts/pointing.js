/** What the pointer and the keys do in a plot of curves: show values, zoom, open the runs of a point. */
import { html, svg } from "../page/dom.js";
import { openRuns } from "../page/data.js";
import { minus, number, withUnit } from "../page/numbers.js";
import { paint, sample } from "./look.js";

const REACH = 90; // px, largest distance at which the pointer finds a point

export class Pointing {
  /** @param {LineChart} owner has plot, picture, box, shown, place and y of the current drawing */
  constructor(owner) {
    this.owner = owner;
    this.tip = html("div", { class: "tip", role: "status", hidden: true });
    this.cursor = svg("g", { class: "cursor" });
    this.#listen();
  }

  /** Adds the cursor and the box of values to a new picture. The pointer is at no point. */
  renew() {
    this.cursor = svg("g", { class: "cursor" });
    this.owner.picture.append(this.cursor);
    this.owner.plot.append(this.tip);
    this.tip.hidden = true;
    this.pointed = null;
  }

  #listen() {
    const { plot } = this.owner;
    plot.addEventListener("pointermove", (event) => this.#move(event));
    plot.addEventListener("pointerleave", () => {
      if (!this.dragged) this.#point(null);
    });
    plot.addEventListener("pointerdown", (event) => this.#press(event));
    plot.addEventListener("pointerup", (event) => this.#release(event));
    plot.addEventListener("pointercancel", () => {
      this.dragged = null;
      this.#brush();
    });
    plot.addEventListener("dblclick", () => this.owner.zoom(null));
    plot.addEventListener("keydown", (event) => this.#key(event));
    plot.addEventListener("blur", () => this.#point(null));
  }

  #pixel(event) {
    const frame = this.owner.plot.getBoundingClientRect();
    return [event.clientX - frame.left, event.clientY - frame.top];
  }

  #seen() {
    return (this.owner.shown ?? [])
      .flatMap(({ points }) => points)
      .filter((p) => p.at[0] >= this.owner.box.left - 2 && p.at[0] <= this.owner.box.right + 2);
  }

  #move(event) {
    if (!this.owner.box) return;
    const at = this.#pixel(event);
    if (this.dragged) {
      this.dragged.to = at[0];
      this.#brush();
      return;
    }
    const weight = this.owner.chart.x.name === "time" ? 4 : 1; // the time counts more than the value
    let best = null,
      least = REACH ** 2;
    for (const p of this.#seen()) {
      const distance = (weight * (p.at[0] - at[0])) ** 2 + (p.at[1] - at[1]) ** 2;
      if (distance < least) [best, least] = [p, distance];
    }
    this.#point(best);
  }

  #press(event) {
    if (event.button !== 0 || event.pointerType === "touch" || this.owner.bands || !this.owner.box) return;
    const [x] = this.#pixel(event);
    if (x < this.owner.box.left || x > this.owner.box.right) return;
    this.dragged = { from: x, to: x };
    this.owner.plot.setPointerCapture(event.pointerId);
  }

  #release(event) {
    const dragged = this.dragged;
    this.dragged = null;
    this.#brush();
    if (event.button !== 0) return;
    if (dragged && Math.abs(dragged.to - dragged.from) > 8) {
      const clamp = (x) => Math.min(Math.max(x, this.owner.box.left), this.owner.box.right);
      const ends = [dragged.from, dragged.to]
        .sort((a, b) => a - b)
        .map((x) => this.owner.place.scale.invert(clamp(x)));
      this.owner.zoom(ends);
    } else if (this.pointed?.runs.length) {
      openRuns(this.pointed.runs, this.owner.plot);
    }
  }

  #brush() {
    this.band?.remove();
    if (!this.dragged || Math.abs(this.dragged.to - this.dragged.from) < 3) return;
    const [a, b] = [this.dragged.from, this.dragged.to].sort((x, y) => x - y);
    this.band = svg("rect", {
      class: "brush",
      x: a,
      width: b - a,
      y: this.owner.box.top,
      height: this.owner.box.bottom - this.owner.box.top,
    });
    this.owner.picture.append(this.band);
  }

  #zoomBy(factor) {
    if (this.owner.bands) return;
    const { scale } = this.owner.place,
      { left, right } = this.owner.box;
    const middle = this.pointed?.at[0] ?? (left + right) / 2;
    const ends = [middle - (middle - left) * factor, middle + (right - middle) * factor];
    const whole = factor > 1 && ends[1] - ends[0] > 4 * (right - left);
    const before = this.pointed;
    this.owner.zoom(whole ? null : ends.map((x) => scale.invert(x)));
    this.#point((before && this.#seen().find((p) => p.series === before.series && p.i === before.i)) || null);
  }

  #key(event) {
    const key = event.key;
    if (key === "+" || key === "=") this.#zoomBy(0.6);
    else if (key === "-") this.#zoomBy(1 / 0.6);
    else if (key === "0") this.owner.zoom(null);
    else if (key === "Enter" && this.pointed?.runs.length) openRuns(this.pointed.runs, this.owner.plot);
    else if (key === "Escape" && this.pointed) this.#point(null);
    else if (key.startsWith("Arrow")) this.#step(key);
    else return;
    event.preventDefault();
  }

  // Moves to the next point of the series, or to the next series at the same position on the axis.
  #step(key) {
    const forward = this.owner.bands ? ["ArrowDown", "ArrowUp"] : ["ArrowRight", "ArrowLeft"];
    const seen = this.owner.shown.map(({ points }) => points).filter((points) => points.length);
    if (!seen.length) return;
    const now = this.pointed;
    if (!now) return this.#point(seen[0][0]);
    const s = seen.findIndex((points) => points.includes(now)),
      points = seen[s] ?? seen[0];
    const along = forward.indexOf(key);
    if (along >= 0) {
      const next = points.indexOf(now) + (along === 0 ? 1 : -1);
      return this.#point(points[Math.min(Math.max(next, 0), points.length - 1)]);
    }
    const others = seen
      .flatMap((all) => all.filter((p) => p.x === now.x))
      .sort((a, b) => (this.owner.bands ? a.at[0] - b.at[0] : b.at[1] - a.at[1]));
    const next = others.indexOf(now) + (key === "ArrowUp" || key === "ArrowRight" ? 1 : -1);
    this.#point(others[Math.min(Math.max(next, 0), others.length - 1)]);
  }

  // Shows the values of a point.
  #point(p) {
    this.pointed = p;
    this.cursor?.replaceChildren();
    this.owner.plot.classList.toggle("opens-run", Boolean(p?.runs.length));
    this.tip.hidden = !p;
    if (!p) return;
    const ring = svg("circle", { class: "ring", cx: p.at[0], cy: p.at[1], r: 8 });
    this.cursor.append(paint(ring, p.series.look));
    this.tip.replaceChildren(...this.#tipText(p));
    const width = this.owner.plot.clientWidth,
      tip = this.tip.getBoundingClientRect();
    const x = p.at[0] + 16 + tip.width > width ? p.at[0] - 16 - tip.width : p.at[0] + 16;
    this.tip.style.left = `${Math.max(0, x)}px`;
    this.tip.style.top = `${Math.max(0, p.at[1] - tip.height / 2)}px`;
  }

  #tipText(p) {
    const { chart, y } = this.owner;
    const place = this.owner.bands ? chart.x.categories[p.x] : exact(p.x, chart.x.unit);
    const lines = [
      html("strong", {}, sample(p.series.look, this.owner.bands ? "mark" : "line"), p.series.label),
    ];
    const rows = [[y.label, Number.isFinite(p.y) ? withUnit(p.y, y.unit, 4) : "diverged"]];
    if (p.low !== p.high) rows.push(["from, to", `${number(p.low, 4)}, ${number(p.high, 4)}`]);
    rows.push([chart.x.label, place]);
    if (p.runs.length > 1) rows.push(["runs", String(p.runs.length)]);
    lines.push(
      html("dl", {}, ...rows.flatMap(([name, text]) => [html("dt", {}, name), html("dd", {}, text)])),
    );
    return lines;
  }
}

// The text of a value on the axis, without trailing zeros.
function exact(x, unit) {
  const text =
    Math.abs(x) >= 1e5 || (x !== 0 && Math.abs(x) < 1e-3)
      ? number(x)
      : minus(String(Number(x.toPrecision(5))));
  return unit && unit !== "1" ? `${text}\u202f${unit}` : text;
}
