/** Axes of a chart as SVG: grid, ticks, title. A title is a list of lines. */
import { svg } from "../page/dom.js";

export const LETTER = 7, // px, about the width of a letter
  LINE = 14; // px between the lines of a text

/** A text in lines of at most `most` letters. */
export function wrapped(text, most) {
  const lines = [""];
  for (const word of text.split(" "))
    if (lines.at(-1) && lines.at(-1).length + word.length >= most) lines.push(word);
    else lines[lines.length - 1] += (lines.at(-1) ? " " : "") + word;
  return lines;
}

/** Lines of text, the last one at `y`. */
export function written(lines, { y, ...attributes }) {
  return lines.map((line, i) => svg("text", { ...attributes, y: y + LINE * (i + 1 - lines.length) }, line));
}

/** The axis below the plot. `box`: {left, right, top, bottom} of the plot in px. */
export function bottomAxis({ scale, ticks, text }, box, title, grid) {
  const group = svg("g", { class: "axis", "aria-hidden": "true" });
  for (const tick of ticks) {
    const x = scale(tick);
    if (grid) group.append(svg("path", { class: "grid", d: `M${x} ${box.top}V${box.bottom}` }));
    else group.append(svg("path", { class: "tick", d: `M${x} ${box.bottom}v5` }));
    group.append(svg("text", { x, y: box.bottom + 19, "text-anchor": "middle" }, text(tick)));
  }
  group.append(svg("path", { class: "base", d: `M${box.left} ${box.bottom}H${box.right}` }));
  group.append(...across(title, box, box.bottom + 39 + LINE * (title.length - 1)));
  return group;
}

/** A second axis above the plot, for a chart that is taller than a screen. Its ticks are at `y`. */
export function topAxis({ scale, ticks, text }, box, title, y) {
  const group = svg("g", { class: "axis", "aria-hidden": "true" });
  for (const tick of ticks)
    group.append(svg("text", { x: scale(tick), y, "text-anchor": "middle" }, text(tick)));
  group.append(...across(title, box, y - 20));
  return group;
}

const across = (title, box, y) =>
  written(title, { class: "title", x: (box.left + box.right) / 2, y, "text-anchor": "middle" });

/** The axis left of the plot. Its title is above the axis and is not rotated. `above`: the names of
 * categories are above their lines. */
export function leftAxis({ kind, scale, ticks, text }, box, title, above) {
  const group = svg("g", { class: "axis", "aria-hidden": "true" });
  for (const tick of ticks) {
    const y = scale(tick);
    const place = above
      ? { x: box.left, y: y + 11 - scale.step() / 2 }
      : { x: box.left - 8, y: y + 4, "text-anchor": "end" };
    group.append(svg("path", { class: "grid", d: `M${box.left} ${y}H${box.right}` }));
    group.append(svg("text", { ...place, class: kind === "band" ? "category" : null }, text(tick)));
  }
  group.append(...written(title, { class: "title", x: 0, y: 12 + LINE * (title.length - 1) }));
  return group;
}
