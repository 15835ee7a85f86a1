/** The keys of a player, and their list, which "?" opens. Keys act while the player has the focus. */
import { html } from "../page/dom.js";

/** [keys as in event.key, after Shift+ or Ctrl+; keys as text; what they do; the action of the player] */
export const KEYS = [
  ["Time",
    [[" ", "k"], "Space", "play, pause", (p) => p.toggle()],
    [["ArrowLeft"], "←", "one frame back", (p) => p.step(-1)],
    [["ArrowRight"], "→", "one frame forward", (p) => p.step(1)],
    [["PageUp"], "Page up", "ten frames back", (p) => p.step(-10)],
    [["PageDown"], "Page down", "ten frames forward", (p) => p.step(10)],
    [["Home"], "Home", "first frame", (p) => p.seek(p.first)],
    [["End"], "End", "last frame", (p) => p.seek(p.last)],
    [["["], "[", "slower", (p) => p.changeSpeed(-1)],
    [["]"], "]", "faster", (p) => p.changeSpeed(1)],
    [["l"], "L", "loop", (p) => p.setLoop(!p.loop)]],
  ["Camera",
    [["Shift+ArrowLeft"], "Shift ←", "turn left", (p) => p.move((o) => o.turn(-8, 0))],
    [["Shift+ArrowRight"], "Shift →", "turn right", (p) => p.move((o) => o.turn(8, 0))],
    [["Shift+ArrowUp"], "Shift ↑", "look from above", (p) => p.move((o) => o.turn(0, 6))],
    [["Shift+ArrowDown"], "Shift ↓", "look from below", (p) => p.move((o) => o.turn(0, -6))],
    [["Ctrl+ArrowLeft"], "Ctrl ← → ↑ ↓", "move the picture", (p) => p.move((o) => o.pan(-0.06, 0))],
    [["Ctrl+ArrowRight"], "", "", (p) => p.move((o) => o.pan(0.06, 0))],
    [["Ctrl+ArrowUp"], "", "", (p) => p.move((o) => o.pan(0, 0.06))],
    [["Ctrl+ArrowDown"], "", "", (p) => p.move((o) => o.pan(0, -0.06))],
    [["+", "="], "+", "nearer", (p) => p.move((o) => o.zoom(0.87))],
    [["-", "_"], "−", "farther", (p) => p.move((o) => o.zoom(1.15))],
    [["r"], "R", "first view", (p) => p.resetCameras()],
    [["c"], "C", "cameras locked together, or one for each run", (p) => p.setLinked(!p.linked)]],
  ["Colours",
    [["q"], "Q", "next quantity", (p) => p.nextQuantity(1)],
    [["Q"], "Shift Q", "quantity before", (p) => p.nextQuantity(-1)],
    [["d"], "D", "compare with the next run", (p) => p.nextReference()],
    [["g"], "G", "lines of the mesh", (p) => p.setLines(!p.lines)]],
  ["Values",
    [["v"], "V", "choose a vertex by its number", (p) => p.askFor("vertex")],
    [["t"], "T", "choose a triangle by its number", (p) => p.askFor("triangle")],
    [["Escape"], "Esc", "close the values", (p) => p.clearPick()]],
  ["Page",
    [["f"], "F", "full screen", (p) => p.fullScreen()],
    [["s"], "S", "save this picture (PNG)", (p) => p.saveStill()],
    [["a"], "A", "save the motion (WebM or animated PNG)", (p) => p.saveAnimation()],
    [["?"], "?", "this list", (p) => p.showKeys()]],
];

/** Handles a key event. Returns whether the key is a key of the player. */
export function pressed(player, event) {
  if (event.altKey || event.metaKey || event.defaultPrevented) return false;
  const typed = event.target.closest("input:not([type=range]):not([type=checkbox]), textarea, select");
  if (typed && event.key !== "Escape") return false;
  if (event.target.closest("dialog.player-keys")) return false;
  if (event.key.startsWith("Arrow") && event.target.closest(".player-panel .scroll")) return false; // scrolls
  if (event.key === " " && event.target.closest("button, summary, a, [type=checkbox]")) return false;
  const letter = event.key.length === 1 ? event.key : null;
  const shift = event.shiftKey && !letter ? "Shift+" : "";
  const name = `${event.ctrlKey ? "Ctrl+" : ""}${shift}${event.key}`;
  for (const [, ...keys] of KEYS)
    for (const [names, , , act] of keys)
      if (names.includes(name)) {
        if (event.key === "Escape" && !player.hasPick()) return false;
        event.preventDefault();
        act(player);
        return true;
      }
  return false;
}

/** A dialog with all keys. */
export function keysDialog() {
  const close = html("button", { type: "button", class: "player-close", "aria-label": "Close", onclick: () =>
    dialog.close() }, "×");
  const dialog = html("dialog", { class: "player-keys", "aria-label": "Keys of the player" }, close,
    html("h3", {}, "Keys"),
    html("p", {}, "The keys act while the player has the focus. Drag to turn the cloth; drag with the " +
      "right button or two fingers to move the picture. Pinch to zoom, or click a view and turn the wheel. " +
      "Click or tap the cloth to see values."),
    html("div", { class: "player-keys-list" }, ...KEYS.map(([name, ...keys]) => html("table", {},
      html("caption", {}, name), html("tbody", {}, ...keys.filter(([, text]) => text).map(([, text, what]) =>
        html("tr", {}, html("td", {}, html("kbd", {}, text)), html("td", {}, what))))))));
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  return dialog;
}
