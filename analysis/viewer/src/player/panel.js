/** The values of the picked vertex and triangle, with a column for each run. Lengths in m. */
import { html } from "../page/dom.js";
import { minus, number } from "../page/numbers.js";
import { stretchesOf, stretchUncertainty } from "./fields.js";

export class Panel {
  /** @param {(kind: "vertex"|"triangle", index: number) => void} choose @param {() => void} close */
  constructor(choose, close) {
    const field = (kind) => html("input", { type: "number", min: 0, step: 1, "aria-label": `Number of a ${kind}`,
      oninput: (event) => { this.typing = event.target; },
      onblur: () => { this.typing = null; },
      onchange: (event) => {
        this.typing = null;
        if (event.target.value !== "" && !this.element.hidden) choose(kind, Number(event.target.value));
      } });
    this.typing = null; // the field in which the user is typing a number
    this.vertex = field("vertex");
    this.triangle = field("triangle");
    this.table = html("table", {});
    this.springs = html("p", { class: "player-springs" });
    this.element = html("section", { class: "player-panel", "aria-label": "Picked values", hidden: true },
      html("div", { class: "player-panel-head" },
        html("label", {}, "Vertex ", this.vertex), html("label", {}, "Triangle ", this.triangle),
        html("button", { type: "button", onclick: close, title: "Close (Esc)", "aria-label": "Close the values" }, "×")),
      html("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Picked values" }, this.table),
      this.springs);
  }

  /** @param {import("./view.js").View[]} views @param {object} extra rows by name → (view) => text */
  show(views, extra = []) {
    const picked = views.filter((view) => view.picked.vertex !== null);
    this.element.hidden = !picked.length;
    if (!picked.length) return;
    const [first] = picked;
    // A number that the user is typing stays, although every new picture updates the panel.
    if (this.typing !== this.vertex) this.vertex.value = first.picked.vertex;
    if (this.typing !== this.triangle) this.triangle.value = first.picked.triangle ?? "";
    const row = (name, text, meaning = "") => html("tr", {}, html("th", { scope: "row", title: meaning }, name),
      ...picked.map((view) => html("td", {}, text(view))));
    const group = (name) => html("tr", { class: "player-group" },
      html("th", { scope: "rowgroup", colspan: picked.length + 1 }, name));
    this.table.replaceChildren(
      html("thead", {}, html("tr", {}, html("td", {}),
        ...picked.map((view) => html("th", { scope: "col" }, view.run.label)))),
      html("tbody", {},
        row("frame", (view) => `${view.frames.head.chosen[view.frame]} (${number(view.time, 4)} s)`),
        group("Vertex"),
        row("number", (view) => String(view.picked.vertex)),
        row("position (m)", positionText, "x, y, z; the page rounds positions to multiples of a step"),
        row("rounded by at most (m)", (view) => `± ${number(view.frames.head.step / 2, 2)}`),
        row("from its rest place (m)", (view) => number(awayFromRest(view), 4)),
        row("speed (m/s)", (view) => number(speed(view), 3), "since the recorded frame before"),
        ...extra.filter(({ of }) => of === "vertex").map(({ name, text }) => row(name, text)),
        group("Triangle"),
        row("number", (view) => view.picked.triangle === null ? "–" : String(view.picked.triangle)),
        row("vertices", (view) => view.picked.triangle === null ? "–"
          : [...view.mesh.triangles.subarray(3 * view.picked.triangle, 3 * view.picked.triangle + 3)].join(", ")),
        row("stretch σ₁", (view) => stretchText(view, 0), "larger principal stretch; ± error by rounding"),
        row("stretch σ₂", (view) => stretchText(view, 1), "smaller principal stretch"),
        ...extra.filter(({ of }) => of === "triangle").map(({ name, text }) => row(name, text))));
    this.#showSprings(picked);
  }

  #showSprings(picked) {
    this.springs.replaceChildren();
    const lines = new Map();
    for (const view of picked) {
      const { missing } = view.frames.head.springs;
      const text = view.picked.springs.length
        ? view.picked.springs.map(({ ring, count }) => ({ ring, text: `ring ${ring}: ${count}` }))
        : missing ?? (view.picked.read ? "No spring acts on this vertex." : "Its springs are being read …");
      const key = typeof text === "string" ? text : view.run.id;
      lines.set(key, { label: lines.has(key) ? `${lines.get(key).label}; ${view.run.label}` : view.run.label, text,
                       rings: view.picked.rings });
    }
    for (const { label, text, rings } of lines.values()) {
      const line = html("span", {}, html("b", {}, picked.length > 1 ? `Springs of ${label} ` : "Springs "));
      if (typeof text === "string") line.append(text);
      else for (const { ring, text: said } of text) {
        const dot = html("i", { class: "player-ring" });
        dot.style.background = rings[(ring - 1 + rings.length) % rings.length];
        line.append(html("span", { class: "player-ring-text" }, dot, said), " ");
      }
      this.springs.append(line);
    }
  }
}

const vertexPlace = (view, positions) => positions.subarray(3 * view.picked.vertex, 3 * view.picked.vertex + 3);

function positionText(view) {
  const digits = Math.max(0, Math.ceil(-Math.log10(view.frames.head.step)));
  return [...vertexPlace(view, view.cloth.positions)].map((x) => minus(x.toFixed(digits))).join(", ");
}

function awayFromRest(view) {
  const rest = vertexPlace(view, view.mesh.rest);
  return Math.hypot(...vertexPlace(view, view.cloth.positions).map((x, c) => x - rest[c]));
}

function speed(view) {
  if (view.frame === 0) return NaN;
  const before = vertexPlace(view, view.frames.positions(view.frame - 1));
  const moved = Math.hypot(...vertexPlace(view, view.cloth.positions).map((x, c) => x - before[c]));
  return moved / (view.time - view.frames.times[view.frame - 1]);
}

function stretchText(view, which) {
  const t = view.picked.triangle;
  if (t === null) return "–";
  const off = stretchUncertainty(view.mesh, t, view.frames.head.step);
  const digits = Math.min(6, Math.max(2, Math.ceil(-Math.log10(off))));
  return `${stretchesOf(view.mesh, view.cloth.positions, t)[which].toFixed(digits)} ± ${number(off, 1)}`;
}
