/** Saves the picture or the motion of a player. */
import { pageData } from "../page/data.js";
import { save } from "../page/dom.js";
import { AnimatedPng } from "./apng.js";
import { compose, recordWebm, STRIP, webmType } from "./save.js";

const PICTURES_PER_SECOND = 15; // of an animated PNG
const FINE_ENOUGH = 1; // level of detail of moving pictures that are saved (stage.js)

export class Recorder {
  constructor(player) {
    this.player = player;
    this.recording = false;
    this.slowest = 100; // ms per picture; slower pictures would be lost in a WebM, which runs in real time
  }

  /** A canvas with the picture, its labels, time and colour bar. */
  #canvas(read = false) {
    const { player } = this;
    const canvas = document.createElement("canvas");
    canvas.width = player.controls.canvas.width;
    canvas.height = player.controls.canvas.height + Math.round(STRIP * player.stage.ratio);
    const style = getComputedStyle(player.element);
    const look = { paper: style.getPropertyValue("--paper").trim() || "#fff",
                   ink: style.getPropertyValue("--ink").trim() || "#222",
                   label: style.getPropertyValue("--ink").trim() || "#222" };
    canvas.dataset.ink = look.ink;
    return { canvas, look, context: canvas.getContext("2d", { willReadFrequently: read }) };
  }

  #compose({ context, look }) {
    const { player } = this;
    const reference = player.reference;
    const quantity = player.compare.quantity(player.key, reference);
    compose(context, { canvas: player.controls.canvas, ratio: player.stage.ratio, time: player.time, look,
      cells: player.cells.map(({ view, x, y, width }) => ({ x, y, width, label: view.run.label })),
      bar: quantity.map ? { quantity, range: player.compare.range(player.key, player.views, reference),
                            colours: pageData().colours.maps[quantity.map] } : null });
  }

  #name(ending) {
    const labels = this.player.views.map((view) => view.run.label).join("_");
    return `${labels.replace(/[^\p{L}\p{N}_.=-]+/gu, "-").slice(0, 80)}${ending}`;
  }

  async still() {
    const { player } = this;
    if (!player.views.length) return null;
    player.stop();
    player.drawNow();
    const target = this.#canvas();
    this.#compose(target);
    const blob = await new Promise((resolve) => target.canvas.toBlob(resolve, "image/png"));
    save(this.#name(`-${player.time.toFixed(2)}s.png`), blob);
    player.controls.say("Picture saved.");
    return blob;
  }

  /** Saves the motion from first to last frame, at the chosen speed. A second call ends the recording. */
  async animation() {
    const { player } = this;
    if (!player.views.length) return null;
    if (this.recording) {
      this.recording = false;
      return null;
    }
    player.stop();
    this.recording = true;
    player.controls.update();
    const before = player.time, { stage } = player, level = stage.movingLevel;
    stage.movingLevel = Math.min(level, FINE_ENOUGH);
    player.drawNow(true, true); // so that the canvas has the size of the pictures that follow
    const target = this.#canvas(true); // each picture is read at once, so that none falls behind its time
    const found = webmType();
    const type = found && this.#pictureTime(target) <= this.slowest ? found : null;
    try {
      const blob = type ? await recordWebm(target.canvas, type, (drawn) => this.#inTime(target, drawn))
        : await this.#pictures(target);
      save(this.#name(type ? ".webm" : ".png"), blob);
      player.controls.say(type ? "Animation saved." : "Animation saved as animated PNG.");
      return blob;
    } catch (error) {
      player.controls.say(`No animation was saved: ${error.message}`);
      return null;
    } finally {
      this.recording = false;
      stage.movingLevel = level;
      player.controls.update();
      player.seek(before);
    }
  }

  #inTime(target, drawn) {
    const { player } = this;
    return new Promise((resolve) => {
      let start = null;
      const tick = (now) => {
        // The time starts when the first picture is drawn
        player.time = start === null ? player.first
          : Math.min(player.first + Math.max(0, now - start) / 1000 * player.speed, player.last);
        player.drawNow(true, true);
        this.#compose(target);
        drawn();
        start ??= performance.now();
        player.controls.say(`Recording, ${Math.round(100 * this.#share())} % …`);
        if (player.time < player.last && this.recording) requestAnimationFrame(tick);
        else this.#hold(drawn).then(resolve);
      };
      requestAnimationFrame(tick);
    });
  }

  /** Milliseconds that a picture takes. */
  #pictureTime(target) {
    const start = performance.now();
    for (let i = 0; i < 3; ++i) {
      this.player.drawNow(true, true);
      this.#compose(target);
      target.context.getImageData(0, 0, 1, 1);
    }
    return (performance.now() - start) / 3;
  }

  /** Shows the last picture for a moment, so that a slow machine can encode all pictures. */
  async #hold(drawn) {
    for (let i = 0; i < 6; ++i) {
      await new Promise((resume) => setTimeout(resume, 120));
      drawn();
    }
  }

  #share() {
    const { first, last, time } = this.player;
    return last > first ? (time - first) / (last - first) : 1;
  }

  async #pictures(target) {
    const { player } = this;
    const file = new AnimatedPng();
    const step = player.speed / PICTURES_PER_SECOND;
    const count = Math.max(1, Math.ceil((player.last - player.first) / step));
    for (let i = 0; i <= count && this.recording; ++i) {
      player.time = Math.min(player.first + i * step, player.last);
      player.drawNow(true, true);
      this.#compose(target);
      const { width, height } = target.canvas;
      await file.add(target.context.getImageData(0, 0, width, height), i === count ? 1 : 1 / PICTURES_PER_SECOND);
      player.controls.say(`Recording, ${Math.round(100 * this.#share())} % …`);
    }
    return file.blob();
  }
}
