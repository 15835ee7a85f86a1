/** Icons of the player's buttons, as SVG paths on 24 × 24. */
import { svg } from "../page/dom.js";

const PATHS = {
  play: "M7 4.5v15l12.5-7.5z", pause: "M7 5h3.6v14H7zM13.4 5H17v14h-3.6z",
  back: "M17 5v14l-9-7zM5 5h2.2v14H5z", forward: "M7 5v14l9-7zM16.8 5H19v14h-2.2z",
  loop: "M17 3l4 4-4 4V8H8a3 3 0 0 0-3 3v1H3v-1a5 5 0 0 1 5-5h9zM7 21l-4-4 4-4v3h9a3 3 0 0 0 3-3v-1h2v1a5 5 0 0 1-5 5H7z",
  link: "M10.6 13.4a4 4 0 0 0 5.7 0l3.5-3.5a4 4 0 0 0-5.7-5.7l-1.6 1.6 1.4 1.4 1.6-1.6a2 2 0 0 1 2.9 2.9l-3.5 3.5a2 2 0 0 1-2.9 0zM13.4 10.6a4 4 0 0 0-5.7 0l-3.5 3.5a4 4 0 0 0 5.7 5.7l1.6-1.6-1.4-1.4-1.6 1.6a2 2 0 0 1-2.9-2.9l3.5-3.5a2 2 0 0 1 2.9 0z",
  reset: "M12 5V1.8L7.3 6.2 12 10.6V7a5.5 5.5 0 1 1-5.5 5.5h-2A7.5 7.5 0 1 0 12 5z",
  full: "M4 4h6v2H6v4H4zM14 4h6v6h-2V6h-4zM4 14h2v4h4v2H4zM18 14h2v6h-6v-2h4z",
  camera: "M9 4h6l1.6 2.4H20a1.6 1.6 0 0 1 1.6 1.6v10A1.6 1.6 0 0 1 20 19.6H4A1.6 1.6 0 0 1 2.4 18V8A1.6 1.6 0 0 1 4 6.4h3.4zM12 9a4 4 0 1 0 0 8 4 4 0 0 0 0-8z",
  film: "M3 5h18v14H3zM5 7v2h2V7zm0 4v2h2v-2zm0 4v2h2v-2zm12-8v2h2V7zm0 4v2h2v-2zm0 4v2h2v-2zM9 7v10h6V7z",
  grid: "M3 20L12 3l9 17zm4.2-2.4h4V10zm9.6 0L12.8 10v7.6z",
};

export function icon(name) {
  return svg("svg", { viewBox: "0 0 24 24", width: 18, height: 18, "aria-hidden": "true", focusable: "false" },
    svg("path", { d: PATHS[name], fill: "currentColor", "fill-rule": "evenodd" }));
}

/** Another icon for a button. */
export function setIcon(button, name) {
  button.querySelector("path").setAttribute("d", PATHS[name]);
}
