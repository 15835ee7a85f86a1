/** Shows all runs of a report at once: parallel coordinates, groups, and a chart of any two numbers. */
import { choice } from "../charts/controls.js";
import { LineChart } from "../charts/line_chart.js";
import { openRuns, pageData } from "../page/data.js";
import { button, html } from "../page/dom.js";
import { choose, chosenRuns, isChosen, whenChosen } from "../page/selection.js";
import { dimensions } from "./dimensions.js";
import { groupTable } from "./groups.js";
import { Parallel } from "./parallel.js";

const MOST_LINES = 8; // dimensions that are shown at first

/** Fills `<div id="explorer">`. */
export function startExplorer() {
  const element = document.getElementById("explorer");
  if (element && pageData().explorer) new Explorer(element);
}

class Explorer {
  constructor(element) {
    Object.assign(this, dimensions());
    this.all = [...this.axes, ...this.numbers];
    this.runs = pageData().runs.filter((run) => run.summary);
    const axes = this.axes.slice(0, 5);
    const time = this.numbers.find((each) => each.name === "ms_per_frame");
    const others = this.numbers.filter((each) => each !== time).slice(0, MOST_LINES - 1 - axes.length);
    this.shown = [...axes, ...others, ...(time ? [time] : [])];
    this.colouring = this.axes.find((axis) => axis.looks) ?? null;
    this.parallel = new Parallel((id) => openRuns([id]), () => choose(this.parallel.inside));
    this.count = html("output", {});
    this.clear = button("All runs", () => {
      this.parallel.clear();
      choose(null);
    });
    this.groups = html("div", {});
    this.figure = html("figure", { class: "chart drawn" });
    this.x = time ?? this.all[0];
    this.y = this.numbers.find((each) => each !== this.x) ?? this.all.at(-1);
    element.replaceChildren(
      this.#tools(),
      this.parallel.element,
      this.groups,
      html("h3", {}, "Any number against any other"),
      this.#pair(),
      this.figure,
    );
    whenChosen(() => this.#mark());
    this.#show();
  }

  #tools() {
    const names = ["one colour", ...this.axes.map((axis) => axis.label)];
    const colour = choice("Colour and group by", names, 1 + this.axes.indexOf(this.colouring), (at) => {
      this.colouring = this.axes[at - 1] ?? null;
      this.#show();
    });
    const boxes = this.all.map((each) =>
      html(
        "label",
        {},
        html("input", {
          type: "checkbox",
          checked: this.shown.includes(each),
          onchange: (event) => {
            const wanted = (other) => (other === each ? event.target.checked : this.shown.includes(other));
            this.shown = this.all.filter(wanted);
            this.#show();
          },
        }),
        ` ${each.label}`,
      ),
    );
    const title = html("summary", {}, "Lines to show");
    const list = html("details", {}, title, html("div", { class: "choices" }, ...boxes));
    return html("div", { class: "tools" }, colour, list, this.clear, this.count);
  }

  #pair() {
    const pick = (label, all, name) =>
      choice(
        label,
        all.map((each) => each.label),
        all.indexOf(this[name]),
        (at) => {
          this[name] = all[at];
          this.#draw();
        },
      );
    const numbers = this.all.filter((each) => each.scale !== "band");
    return html("div", { class: "tools" }, pick("Number", numbers, "y"), pick("Against", this.all, "x"));
  }

  #look(run) {
    const axis = this.colouring;
    return (axis?.looks?.[axis.texts.indexOf(axis.text(run))]) ?? pageData().explorer.plain;
  }

  #show() {
    this.parallel.show(this.shown, this.runs, (run) => this.#look(run));
    this.#draw();
    this.#mark();
  }

  // Draws the curves of the runs that are not chosen pale, and shows the groups of the runs inside the lines.
  #mark() {
    const chosen = this.runs.filter((run) => isChosen([run.id]));
    const all = chosenRuns() === null;
    this.count.textContent = all ? `${this.runs.length} runs` : `${chosen.length} of ${this.runs.length} runs`;
    this.clear.disabled = all;
    this.parallel.mark((id) => isChosen([id]));
    const numbers = this.shown.filter((each) => !each.texts);
    const { inside } = this.parallel;
    const counts = (run) => inside?.includes(run.id) ?? true;
    const ids = new Set(inside ? [] : chosenRuns()); // of the chosen groups
    const isPressed = (group) => group.every(({ id }) => ids.has(id));
    const press = (group) => {
      const pressed = isPressed(group);
      for (const { id } of group) pressed ? ids.delete(id) : ids.add(id);
      this.parallel.clear(); // the groups replace a choice on the lines
      choose(ids.size ? ids : null);
    };
    const buttons = () => [...this.groups.querySelectorAll("button")];
    const at = buttons().indexOf(document.activeElement);
    this.groups.replaceChildren(
      ...(this.colouring ? [groupTable(this.colouring, numbers, this.runs, counts, isPressed, press)] : []),
    );
    buttons()[at]?.focus();
  }

  #draw() {
    this.figure.chart?.dispose();
    this.figure.replaceChildren();
    this.figure.chart = new LineChart(this.figure, this.#chart());
  }

  // The chart of the two chosen dimensions, in the form of the charts in the page's data.
  #chart() {
    const { x, y, colouring } = this;
    const groups = new Map();
    for (const run of this.runs) {
      if (Number.isNaN(x.of(run)) || Number.isNaN(y.of(run))) continue;
      const label = colouring?.text(run) ?? "runs";
      if (!groups.has(label)) groups.set(label, []);
      groups.get(label).push(run);
    }
    const series = [...groups].map(([label, runs]) => {
      const sorted = runs.sort((a, b) => x.of(a) - x.of(b));
      return {
        label,
        look: this.#look(sorted[0]),
        x: sorted.map(x.of),
        y: { [y.name]: sorted.map((run) => finite(y.of(run))) },
        runs: sorted.map((run) => [run.id]),
      };
    });
    const title = `${y.label} against ${x.label}`;
    const scale = x.scale === "band" ? { scale: "band", categories: x.texts } : { scale: x.scale };
    return { id: "explored", kind: "lines", title, x: { ...x, ...scale }, ys: [y], choice: 0, series, held: [],
             limits: [], joined: false, dodge: false, y_scale: y.scale === "log" ? "log" : "linear" };
  }
}

const finite = (x) => (Number.isFinite(x) ? x : x > 0 ? "∞" : "-∞");
