/** Draws series as SVG, in the style (`look`: colours, mark, dash) that analysis/tables/looks.py chooses. */
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

/** Gives an element the two colours of a series; the style sheet takes the colour for light or dark pages. */
export function paint(element, look) {
  element.style.setProperty("--light", look.light);
  element.style.setProperty("--dark", look.dark);
  element.classList.add("painted");
  return element;
}

const AREA = 52; // px², of a mark
// Marks that consist of lines, without an area to fill.
const CROSSED = ["X", "x"];

/** A mark at a place. */
export function mark(look, x, y) {
  const turn = look.mark === "v" ? " rotate(180)" : "";
  return svg("path", {
    class: CROSSED.includes(look.mark) ? "mark crossed" : look.hollow ? "mark hollow" : "mark",
    d: symbol(SHAPES[look.mark] ?? symbolCircle, AREA)(),
    transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})${turn}`,
  });
}

/** A sample in the legend: a mark on a line, or a square for bars. @param {"line"|"mark"|"bar"} kind */
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
