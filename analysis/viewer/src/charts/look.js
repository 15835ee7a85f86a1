/** Colours and marks of series. Python chooses them (analysis/tables/looks.py); here they only become SVG. */
import {
  symbol,
  symbolCircle,
  symbolCross,
  symbolDiamond,
  symbolSquare,
  symbolTriangle,
  symbolTimes,
} from "d3-shape";
import { svg } from "../page/dom.js";

// The marks by matplotlib's names.
const SHAPES = {
  o: symbolCircle,
  s: symbolSquare,
  D: symbolDiamond,
  "^": symbolTriangle,
  v: symbolTriangle,
  P: symbolCross,
  X: symbolTimes,
  x: symbolTimes,
};

/** Gives an element its series' colour, which the style sheet chooses for light and dark. */
export function paint(element, look) {
  element.style.setProperty("--light", look.light);
  element.style.setProperty("--dark", look.dark);
  element.classList.add("painted");
  return element;
}

/** The path of a mark around the origin. @param {number} area in px² */
export function markPath(look, area = 52) {
  return symbol(SHAPES[look.mark] ?? symbolCircle, area)();
}

// Drawn as lines without an inside.
const CROSSED = ["X", "x"];

/** A mark at a place. */
export function mark(look, x, y, area) {
  const turn = look.mark === "v" ? " rotate(180)" : "";
  return svg("path", {
    class: CROSSED.includes(look.mark) ? "mark crossed" : look.hollow ? "mark hollow" : "mark",
    d: markPath(look, area),
    transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})${turn}`,
  });
}

/** A legend's sample: a mark with a piece of line, for bars a square. @param {"line"|"mark"|"bar"} kind */
export function sample(look, kind = "line") {
  const width = kind === "line" ? 26 : 14;
  const picture = svg("svg", {
    class: "sample",
    width,
    height: 14,
    viewBox: `0 0 ${width} 14`,
    "aria-hidden": "true",
  });
  if (kind === "bar") {
    picture.append(svg("rect", { class: "swatch", x: 1, y: 1, width: 12, height: 12, rx: 2 }));
    return paint(picture, look);
  }
  if (kind === "line")
    picture.append(svg("path", { class: "line", d: "M1 7H25", "stroke-dasharray": look.dash }));
  picture.append(mark(look, width / 2, 7));
  return paint(picture, look);
}
