/** Everything around the picture: choices, time, buttons, messages. */
import { pageData } from "../page/data.js";
import { html } from "../page/dom.js";
import { ColourBar } from "./bar.js";
import { icon, setIcon } from "./icons.js";
import { keysDialog } from "./keys.js";
import { MOST } from "./layout.js";
import { Panel } from "./panel.js";
import { runOf } from "./runs.js";

export const SPEEDS = [[0.1, "0.1 ×"], [0.25, "¼ ×"], [0.5, "½ ×"], [1, "1 ×"], [2, "2 ×"], [4, "4 ×"]];

export class Controls {
  constructor(player) {
    this.player = player;
    const press = (name, label, key, act, more = {}) => html("button", { type: "button", class: "player-button",
      "aria-label": label, title: key ? `${label} (${key})` : label, "aria-keyshortcuts": key, onclick: act, ...more },
      icon(name));
    this.quantity = html("select", { "aria-label": "Colour", onchange: (event) => player.setQuantity(event.target.value) });
    this.reference = html("select", { "aria-label": "Compare with", onchange: (event) => player.setReference(event.target.value || null) });
    this.bar = new ColourBar(pageData().colours, (low, high) => player.setRange(low, high));
    this.runs = html("details", { class: "player-runs", hidden: "" });
    this.compareLabel = html("label", {}, html("span", {}, "Compare with"), this.reference);
    this.top = html("div", { class: "player-top" },
      html("label", {}, html("span", {}, "Colour"), this.quantity), this.compareLabel, this.bar.element);
    this.canvas = html("canvas", { "aria-hidden": "true" });
    this.grid = html("div", { class: "player-views" });
    this.message = html("p", { class: "player-message", role: "status" });
    this.stage = html("div", { class: "player-stage" }, this.canvas, this.grid);
    this.playButton = press("play", "Play", "Space", () => player.toggle());
    this.loopButton = press("loop", "Loop", "L", () => player.setLoop(!player.loop), { "aria-pressed": "false" });
    this.linkButton = press("link", "Cameras locked together", "C", () => player.setLinked(!player.linked),
      { "aria-pressed": "true" });
    this.linesButton = press("grid", "Lines of the mesh", "G", () => player.setLines(!player.lines),
      { "aria-pressed": "true" });
    this.fullButton = press("full", "Full screen", "F", () => player.fullScreen());
    this.filmButton = press("film", "Save the motion", "A", () => player.saveAnimation());
    this.slider = html("input", { type: "range", class: "player-slider", "aria-label": "Time", step: "any",
      oninput: (event) => { player.stop(); player.seek(Number(event.target.value)); } });
    this.clock = html("span", { class: "player-clock" });
    this.speed = html("select", { "aria-label": "Speed", title: "Speed ([ slower, ] faster)",
      onchange: (event) => player.setSpeed(Number(event.target.value)) },
      ...SPEEDS.map(([value, text]) => html("option", { value }, text)));
    this.times = html("div", { class: "player-times" },
      press("back", "One frame back", "←", () => player.step(-1), { "aria-keyshortcuts": "ArrowLeft" }),
      this.playButton,
      press("forward", "One frame on", "→", () => player.step(1), { "aria-keyshortcuts": "ArrowRight" }),
      this.slider, this.clock, this.speed, this.loopButton);
    this.tools = html("div", { class: "player-tools" }, this.linkButton,
      press("reset", "First view", "R", () => player.resetCameras()), this.linesButton,
      press("camera", "Save this picture", "S", () => player.saveStill()), this.filmButton, this.fullButton,
      html("button", { type: "button", class: "player-button", "aria-label": "Keys", title: "Keys (?)",
        "aria-keyshortcuts": "?", onclick: () => this.showKeys() }, "?"));
    this.notes = html("ul", { class: "player-notes" });
    this.panel = new Panel((kind, index) => player.pickNumber(kind, index), () => player.clearPick());
    this.keys = keysDialog();
    this.cells = [];
    this.parts = [this.top, this.stage, html("div", { class: "player-bottom" }, this.times, this.tools), this.runs,
                  this.message, this.panel.element, this.notes, this.keys];
  }

  /** Adds an empty view for each run. */
  showCells(runs) {
    this.cells = runs.map((run) => {
      const name = html("span", { class: "player-name" }, run.label);
      const state = run.status && !["complete", "implausible"].includes(run.status) ? run.status : "";
      const cell = html("div", { class: "player-view", tabindex: 0, role: "img",
        "aria-label": `${run.label}: cloth. Click or tap a point for its values.` }, name,
        html("span", { class: "player-state" }, state), html("span", { class: "player-note" }));
      return cell;
    });
    this.grid.replaceChildren(...this.cells);
    const notes = [...new Set(runs.flatMap((run) => (run.frames?.notes ?? []).map((note) =>
      runs.length > 1 ? `${run.label}: ${note}` : note)))];
    this.notes.replaceChildren(...notes.map((note) => html("li", {}, note)));
    this.layOut(Math.min(runs.length, 4), Math.ceil(runs.length / 4), this.stage.clientHeight || 360);
  }

  layOut(columns, rows, height) {
    this.grid.style.gridTemplateColumns = `repeat(${columns}, minmax(0, 1fr))`;
    this.grid.style.gridTemplateRows = `repeat(${rows}, minmax(0, 1fr))`;
    this.stage.style.height = height === null ? "" : `${height}px`;
    this.cells.forEach((cell, i) => {
      cell.classList.toggle("player-left", i % columns === 0);
      cell.classList.toggle("player-upper", i < columns);
    });
  }

  problem(cell, text) {
    cell.classList.add("player-empty");
    cell.setAttribute("aria-label", `${cell.querySelector(".player-name").textContent}: ${text}`);
    const [before, command] = text.split(/(?=\.\/bendlab )/);
    cell.append(html("p", {}, before, command ? html("code", {}, command) : null));
  }

  note(view, text) {
    const cell = this.player.cells.find((each) => each.view === view).element;
    cell.querySelector(".player-note").textContent = text;
  }

  /** Fills the list in which the user chooses the runs to show. A player with a single run has no list. */
  showRuns(shown) {
    const { player } = this;
    this.runs.hidden = player.ids.length < 2;
    if (this.runs.hidden) return;
    const boxes = player.ids.map((id) => html("label", {}, html("input", { type: "checkbox", value: id,
      checked: shown.some((run) => run.id === id), onchange: (event) => this.#chosen(event.target) }),
      runOf(id).label));
    const open = this.runs.open;
    this.runs.replaceChildren(html("summary", {}, `${shown.length} of ${player.ids.length} runs shown`),
      html("div", { class: "player-choices" }, ...boxes));
    this.runs.open = open;
  }

  #chosen(box) {
    const wanted = [...this.runs.querySelectorAll("input:checked")].map((each) => each.value);
    if (!wanted.length || wanted.length > MOST) {
      box.checked = !box.checked;
      this.say(`Between 1 and ${MOST} runs can be shown.`);
      return;
    }
    const value = box.value;
    this.player.show(wanted).then(() => this.runs.querySelector(`input[value="${CSS.escape(value)}"]`)?.focus());
  }

  /** Call it when the runs have been read. */
  ready() {
    const { player } = this;
    for (const part of [this.top, this.times, this.tools]) part.hidden = false;
    this.slider.min = player.first;
    this.slider.max = player.last;
    this.compareLabel.hidden = player.views.length < 2;
    this.reference.replaceChildren(html("option", { value: "" }, "nothing"),
      ...player.views.map((view) => html("option", { value: view.run.id }, view.run.label)));
    this.linkButton.hidden = player.views.length < 2;
    this.update();
    if (player.referenceId) player.setReference(player.referenceId);
  }

  /** Disables the controls, because nothing can be played. */
  disable(text = "") {
    for (const part of [this.top, this.times, this.tools]) part.hidden = true;
    this.stage.style.height = "auto";
    this.stage.classList.add("player-nothing");
    this.say(text);
  }

  /** Updates the controls after a setting has changed. */
  update() {
    const { player } = this;
    const press = (button, pressed) => button.setAttribute("aria-pressed", String(Boolean(pressed)));
    setIcon(this.playButton, player.playing ? "pause" : "play");
    const name = (button, label) => {
      button.setAttribute("aria-label", label);
      button.title = `${label} (${button.getAttribute("aria-keyshortcuts")})`;
    };
    name(this.playButton, player.playing ? "Pause" : "Play");
    press(this.loopButton, player.loop);
    press(this.linkButton, player.linked);
    press(this.linesButton, player.lines);
    name(this.filmButton, player.recorder?.recording ? "End the recording" : "Save the motion");
    this.filmButton.classList.toggle("player-recording", Boolean(player.recorder?.recording));
    this.speed.value = String(player.speed);
    const choices = player.compare.choices(player.reference);
    this.quantity.replaceChildren(...choices.map(({ key, name, meaning }) =>
      html("option", { value: key, title: meaning }, name)));
    this.quantity.value = player.key;
    this.reference.value = player.referenceId ?? "";
  }

  /** Updates the clock and the colour bar. */
  tell(quantity, range) {
    const { player } = this;
    const digits = player.last - player.first < 0.2 ? 4 : 2;
    this.slider.value = player.time;
    this.slider.setAttribute("aria-valuetext", `${player.time.toFixed(digits)} s`);
    this.clock.textContent = `${player.time.toFixed(digits)} / ${player.last.toFixed(digits)} s`;
    const legend = JSON.stringify([quantity.name, range]);
    if (this.legend !== legend) this.bar.show(quantity, range);
    this.legend = legend;
    for (const { view, element } of player.cells) {
      const ended = player.time > view.frames.times.at(-1) + 1e-9;
      const state = element.querySelector(".player-state");
      const text = [view.run.status && !["complete", "implausible"].includes(view.run.status) ? view.run.status : "",
                    ended ? `ends at ${view.frames.times.at(-1).toFixed(digits)} s` : ""].filter(Boolean).join(", ");
      if (state.textContent !== text) state.textContent = text;
    }
  }

  /** Shows a sentence below the picture for six seconds. */
  say(text) {
    this.message.textContent = text;
    clearTimeout(this.saying);
    if (text) this.saying = setTimeout(() => { this.message.textContent = ""; }, 6000);
  }

  showKeys() {
    this.keys.showModal();
  }
}
