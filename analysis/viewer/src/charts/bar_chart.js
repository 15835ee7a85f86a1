/** A chart of bars that consist of parts, for example of the time of each pass. */
import { html, svg } from "../page/dom.js";
import { openRuns } from "../page/data.js";
import { number, titled, withUnit } from "../page/numbers.js";
import { bottomAxis, LINE } from "./axes.js";
import { takeAway, toggle } from "./controls.js";
import { Legend } from "./legend.js";
import { paint } from "./look.js";
import { axisScale, LEAST_WIDTH, NARROW } from "./scales.js";

const ROW = 28; // px

export class BarChart {
  /** @param {HTMLElement} figure @param {Object} chart as in the page's data */
  constructor(figure, chart) {
    this.chart = chart;
    this.shares = false;
    this.legend = new Legend(
      chart.parts,
      "bar",
      () => this.draw(),
      () => {},
    );
    const shares = toggle(
      "Shares",
      false,
      (on) => {
        this.shares = on;
        this.draw();
      },
      "Each bar as shares of its whole",
    );
    const opens = chart.rows.some(({ runs }) => runs?.length) ? ", Enter opens the run" : "";
    this.plot = html("div", {
      class: "plot",
      role: "group",
      "aria-roledescription": "chart",
      tabindex: 0,
      "aria-label": `${chart.title}. Arrow keys go from part to part${opens}.`,
    });
    this.tip = html("div", { class: "tip", role: "status", hidden: true });
    figure.append(
      html("div", { class: "tools" }, shares, takeAway(chart)),
      html("div", { class: "chart-body" }, this.legend.element, this.plot),
    );
    this.plot.addEventListener("keydown", (event) => this.#key(event));
    this.plot.addEventListener("pointerleave", () => this.#point(null));
    this.plot.addEventListener("blur", () => this.#point(null));
    new ResizeObserver(() => this.draw()).observe(this.plot);
  }

  draw() {
    const width = this.paper ?? this.plot.clientWidth;
    if (width < LEAST_WIDTH) return;
    const { rows, parts, x } = this.chart;
    const shown = parts.map((part) => !this.legend.hidden.has(part.label));
    const sums = rows.map((row) => sum(row.values.filter((_, i) => shown[i])));
    const above = width < NARROW,
      pitch = above ? ROW + LINE : ROW,
      top = x.rows ? 26 : 4,
      down = above ? 17 : 0;
    const left = above
      ? 4
      : Math.min(Math.max(...rows.map((row) => row.label.length)) * 7.2 + 14, width * 0.42);
    const bottom = top + 4 + rows.length * pitch,
      box = { left, right: width - 64, top, bottom };
    const most = this.shares ? 1 : Math.max(...sums) || 1;
    const axis = axisScale("linear", [0, most], [left, box.right], null, 80);
    if (this.shares) axis.text = (share) => `${Math.round(100 * share)} %`;
    const height = bottom + 46;
    this.picture = svg(
      "svg",
      { class: "picture bars", width, height, viewBox: `0 0 ${width} ${height}` },
      bottomAxis(axis, box, [this.shares ? "share" : titled(x.label, x.unit)], true),
      x.rows && svg("text", { class: "title", x: 0, y: 12 }, x.rows),
    );
    this.cells = [];
    rows.forEach((row, r) => {
      const y = top + 4 + r * pitch + down,
        scale = this.shares ? 1 / (sums[r] || 1) : 1;
      const room = (above ? width : left) / 6.9;
      this.picture.append(
        svg(
          "text",
          {
            class: "category",
            x: above ? left : left - 8,
            y: above ? y - 2 : y + 16,
            "text-anchor": above ? "start" : "end",
          },
          row.label.length > room ? `${row.label.slice(0, Math.floor(room) - 1)}…` : row.label,
        ),
      );
      let from = 0;
      row.values.forEach((part, i) => {
        if (!shown[i] || !(part > 0)) return;
        const a = axis.scale(from * scale),
          b = axis.scale((from + part) * scale);
        from += part;
        const bar = paint(
          svg("rect", {
            class: "bar",
            x: a,
            y: y + 3,
            width: Math.max(b - a - 1, 0.5),
            height: ROW - 10,
            onpointerenter: () => this.#point(cell),
            onclick: () => this.#open(cell),
          }),
          parts[i].look,
        );
        const cell = { row, r, part: parts[i], value: part, sum: sums[r], x: (a + b) / 2, y: y + 3, bar };
        this.cells.push(cell);
        this.picture.append(bar);
      });
      if (!this.shares) {
        this.picture.append(svg("text", { class: "sum", x: axis.scale(from) + 7, y: y + 16 }, number(from)));
      }
    });
    this.plot.replaceChildren(this.picture, this.tip);
    this.#point(null);
  }

  #open(cell) {
    if (cell?.row.runs?.length) openRuns(cell.row.runs, this.plot);
  }

  #key(event) {
    const now = this.cells.indexOf(this.pointed);
    const row = (r) => this.cells.find((cell) => cell.r === r);
    if (event.key === "ArrowRight") this.#point(this.cells[Math.min(now + 1, this.cells.length - 1)]);
    else if (event.key === "ArrowLeft") this.#point(this.cells[Math.max(now - 1, 0)]);
    else if (event.key === "ArrowDown") this.#point(row((this.pointed?.r ?? -1) + 1) ?? this.pointed);
    else if (event.key === "ArrowUp") this.#point(row((this.pointed?.r ?? 1) - 1) ?? this.pointed);
    else if (event.key === "Enter") this.#open(this.pointed);
    else if (event.key === "Escape" && this.pointed) this.#point(null);
    else return;
    event.preventDefault();
  }

  #point(cell) {
    this.pointed?.bar.classList.remove("pointed");
    this.pointed = cell;
    this.tip.hidden = !cell;
    if (!cell) return;
    cell.bar.classList.add("pointed");
    const rows = [
      [cell.part.label, withUnit(cell.value, this.chart.x.unit)],
      ["share", `${number((100 * cell.value) / cell.sum)} %`],
      ["whole bar", withUnit(cell.sum, this.chart.x.unit)],
    ];
    this.tip.replaceChildren(
      html("strong", {}, cell.row.label),
      html("dl", {}, ...rows.flatMap(([name, text]) => [html("dt", {}, name), html("dd", {}, text)])),
    );
    const tip = this.tip.getBoundingClientRect();
    const most = this.plot.clientWidth - tip.width;
    this.tip.style.left = `${Math.min(Math.max(0, cell.x - tip.width / 2), most)}px`;
    this.tip.style.top = `${cell.y + ROW}px`;
  }
}

const sum = (numbers) => numbers.reduce((all, x) => all + (x > 0 ? x : 0), 0);
