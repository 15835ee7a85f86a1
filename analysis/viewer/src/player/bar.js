/** The colour bar: a quantity, its unit, and the range of the colours, which the user can change. */
import { html } from "../page/dom.js";
import { number } from "../page/numbers.js";

export class ColourBar {
  /** @param {object} colours of the page's data @param {(low: number, high: number) => void} change */
  constructor(colours, change) {
    this.colours = colours;
    this.name = html("span", { class: "player-bar-name" });
    this.canvas = html("canvas", { width: 256, height: 1, class: "player-bar-colours", "aria-hidden": "true" });
    const end = (label) => html("input", { type: "text", inputmode: "decimal", "aria-label": label, size: 6,
      onchange: () => this.#edited(change),
      onkeydown: (event) => event.key === "Enter" && this.#edited(change) });
    this.low = end("Smallest value of the colour bar");
    this.high = end("Largest value of the colour bar");
    this.ticks = html("span", { class: "player-bar-ticks", "aria-hidden": "true" });
    this.element = html("div", { class: "player-colours" }, this.name, this.low,
      html("span", { class: "player-bar-strip" }, this.canvas, this.ticks), this.high);
  }

  /** @param {object} quantity @param {[number, number]} range */
  show(quantity, range) {
    const { map } = quantity;
    this.quantity = quantity;
    this.range = range;
    this.element.hidden = !map;
    if (!map) return;
    const unit = quantity.unit && quantity.unit !== "1" ? ` (${quantity.unit})` : "";
    this.name.textContent = `${quantity.symbol || quantity.name}${unit}`;
    this.name.title = quantity.meaning;
    put(this.low, range[0]);
    put(this.high, range[1]);
    const context = this.canvas.getContext("2d");
    for (let i = 0; i < 256; ++i) {
      context.fillStyle = `#${this.colours.maps[map].substr(6 * i, 6)}`;
      context.fillRect(i, 0, 1, 1);
    }
    this.ticks.replaceChildren(...ticksOf(quantity, range).map(({ share, text }) => {
      const tick = html("span", {}, text);
      tick.style.left = `${100 * share}%`;
      return tick;
    }));
  }

  #edited(change) {
    const [low, high] = [this.low, this.high].map((input) => Number(input.value.replace("−", "-").replace(",", ".")));
    const usable = Number.isFinite(low) && Number.isFinite(high) && low < high &&
      (this.quantity.scale !== "log" || low > 0);
    this.element.classList.toggle("player-wrong", !usable);
    this.element.title = usable ? "" : this.quantity.scale === "log"
      ? "Two positive numbers are needed, the smaller one on the left." : "The smaller number belongs on the left.";
    if (usable) change(low, high);
  }
}

/** Sets a text field, but not while the user is typing in it. */
function put(input, x) {
  if (document.activeElement !== input) input.value = plain(x);
}

/** A number as text that the user can edit. */
function plain(x) {
  return String(Number(x.toPrecision(3)));
}

/** Up to 4 round values within a range. */
export function ticksOf(quantity, [low, high]) {
  const found = [];
  if (quantity.scale === "log") {
    const first = Math.ceil(Math.log10(low) + 1e-9), last = Math.floor(Math.log10(high) - 1e-9);
    const stride = Math.max(1, Math.ceil((last - first + 1) / 4));
    for (let k = first; k <= last; k += stride)
      found.push({ share: Math.log(10 ** k / low) / Math.log(high / low), text: number(10 ** k, 1) });
  } else {
    const unit = 10 ** Math.floor(Math.log10((high - low) / 2));
    const step = (high - low) / unit > 6 ? 5 * unit : (high - low) / unit > 3 ? 2 * unit : unit;
    for (let k = Math.ceil(low / step + 1e-9); k * step < high - 1e-9 * step; ++k)
      found.push({ share: (k * step - low) / (high - low), text: number(Number((k * step).toPrecision(6)), 2)
        .replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "") });
  }
  return found.filter(({ share }) => share > 0.08 && share < 0.92);
}
