/** A table of groups of runs with equal values on an axis: number of runs, and medians of metrics. */
import { html } from "../page/dom.js";
import { number, titled } from "../page/numbers.js";
import { sample } from "../charts/look.js";

/**
 * @param {import("./dimensions.js").Dimension} axis @param {import("./dimensions.js").Dimension[]} numbers
 * @param {Object[]} runs @param {(run: Object) => boolean} counts whether a run counts in its group
 * @param {(group: Object[]) => boolean} isPressed @param {(group: Object[]) => void} press
 */
export function groupTable(axis, numbers, runs, counts, isPressed, press) {
  const rows = axis.texts.map((text, at) => {
    const group = runs.filter((run) => axis.text(run) === text);
    if (!group.length) return null;
    const own = group.filter(counts);
    const name = html(
      "button",
      {
        type: "button",
        class: "opens",
        title: "Choose these runs",
        "aria-pressed": isPressed(group),
        onclick: () => press(group),
      },
      sample(axis.looks[at], "mark"),
      ` ${text}`,
    );
    return html(
      "tr",
      {},
      html("td", { class: "t" }, name),
      html("td", {}, String(own.length)),
      ...numbers.map((each) => html("td", {}, number(median(own.map(each.of))))),
    );
  });
  const heads = ["runs", ...numbers.map((each) => `median ${titled(each.label, each.unit)}`)];
  return html(
    "div",
    { class: "scroll" },
    html(
      "table",
      {},
      html(
        "thead",
        {},
        html("tr", {}, html("th", { class: "t" }, axis.label), ...heads.map((text) => html("th", {}, text))),
      ),
      html("tbody", {}, ...rows.filter(Boolean)),
    ),
  );
}

/** The median of the known numbers; a run that diverged has an infinite number. */
export function median(values) {
  const known = values.filter((x) => !Number.isNaN(x)).sort((a, b) => a - b);
  if (!known.length) return NaN;
  const middle = (known.length - 1) / 2;
  const [low, high] = [known[Math.floor(middle)], known[Math.ceil(middle)]];
  return low === high ? low : (low + high) / 2;
}
