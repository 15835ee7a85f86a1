/** The names of series, as buttons that show or hide a series, beside the ends of curves if there is room. */
import { html } from "../page/dom.js";
import { apart } from "./labels.js";
import { sample } from "./look.js";

const LINE = 21; // px between the names

export class Legend {
  /**
   * @param {{label: string, look: Object, hidden?: boolean}[]} entries
   * @param {"line"|"mark"|"bar"} kind of the samples
   * @param {() => void} changed called after a series was shown or hidden
   * @param {(label: string|null) => void} called when the pointer is at a name; null: at no name
   */
  constructor(entries, kind, changed, pointed) {
    this.hidden = new Set(entries.filter((entry) => entry.hidden).map(({ label }) => label));
    this.buttons = new Map(entries.map(({ label, look }) => [label, this.#button(label, look, kind)]));
    this.element = html(
      "div",
      { class: "legend", role: "group", "aria-label": "Series" },
      ...this.buttons.values(),
    );
    this.changed = changed;
    this.pointed = pointed;
  }

  #button(label, look, kind) {
    const press = (event) => {
      if (event.shiftKey) this.#only(label);
      else this.#flip(label);
      this.#show();
    };
    return html(
      "button",
      {
        type: "button",
        class: "series-name",
        "aria-pressed": !this.hidden.has(label),
        onclick: press,
        title: "Show or hide this series; with Shift: show only this series",
        onpointerenter: () => this.pointed(label),
        onpointerleave: () => this.pointed(null),
        onfocus: () => this.pointed(label),
        onblur: () => this.pointed(null),
      },
      sample(look, kind),
      html("span", {}, label),
    );
  }

  #flip(label) {
    if (!this.hidden.delete(label)) this.hidden.add(label);
  }

  // Shows only this series; if no other series is shown, shows all series.
  #only(label) {
    const alone = this.hidden.size === this.buttons.size - 1 && !this.hidden.has(label);
    this.hidden = new Set(alone ? [] : [...this.buttons.keys()].filter((other) => other !== label));
  }

  #show() {
    for (const [label, button] of this.buttons) button.setAttribute("aria-pressed", !this.hidden.has(label));
    this.changed();
  }

  /** Whether the names fit beside a plot of this height. */
  fits(height) {
    return this.buttons.size * LINE <= height;
  }

  /** Puts the names in a row above the plot, wrapped. */
  flow() {
    this.element.classList.remove("beside");
    for (const button of this.buttons.values()) button.style.removeProperty("top");
  }

  /**
   * Puts the names beside the ends of their curves, and below them the names of curves without a visible end.
   * @param {Map<string, number>} ends label → y in px
   * @param {number} left @param {number} top @param {number} bottom
   * @returns {Map<string, number>} label → y of its name, for curves with an end
   */
  beside(ends, left, top, bottom) {
    this.element.classList.add("beside");
    this.element.style.setProperty("left", `${left}px`);
    const without = [...this.buttons.keys()].filter((label) => !ends.has(label));
    const places = apart([...ends.values()], LINE, top, bottom - without.length * LINE);
    const placed = new Map([...ends.keys()].map((label, i) => [label, places[i]]));
    let below = Math.max(bottom - (without.length - 1) * LINE, Math.max(-Infinity, ...places) + LINE);
    for (const label of without) {
      this.buttons.get(label).style.setProperty("top", `${below}px`);
      below += LINE;
    }
    for (const [label, y] of placed) this.buttons.get(label).style.setProperty("top", `${y}px`);
    return placed;
  }

  /** The widest name in px. */
  get width() {
    return Math.max(...[...this.buttons.values()].map((button) => button.scrollWidth));
  }
}
