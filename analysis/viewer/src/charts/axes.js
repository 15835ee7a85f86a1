/** Axes of a chart as SVG: grid, ticks, title. */
import { svg } from "../page/dom.js";

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
  group.append(
    svg(
      "text",
      { class: "title", x: (box.left + box.right) / 2, y: box.bottom + 39, "text-anchor": "middle" },
      title,
    ),
  );
  return group;
}

/** A second axis above the plot, for a chart that is taller than a screen. */
export function topAxis({ scale, ticks, text }, box, title) {
  const group = svg("g", { class: "axis", "aria-hidden": "true" });
  for (const tick of ticks)
    group.append(svg("text", { x: scale(tick), y: box.top - 20, "text-anchor": "middle" }, text(tick)));
  group.append(
    svg("text", { class: "title", x: (box.left + box.right) / 2, y: box.top - 40, "text-anchor": "middle" }, title),
  );
  return group;
}

/** The axis left of the plot. Its title is above the axis and is not rotated. */
export function leftAxis({ kind, scale, ticks, text }, box, title) {
  const group = svg("g", { class: "axis", "aria-hidden": "true" });
  for (const tick of ticks) {
    const y = scale(tick);
    group.append(svg("path", { class: "grid", d: `M${box.left} ${y}H${box.right}` }));
    group.append(
      svg(
        "text",
        { x: box.left - 8, y: y + 4, "text-anchor": "end", class: kind === "band" ? "category" : null },
        text(tick),
      ),
    );
  }
  if (title) group.append(svg("text", { class: "title", x: 0, y: 12 }, title));
  return group;
}
