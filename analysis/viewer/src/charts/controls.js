/** The controls around a plot: lists, switches, and buttons for the plot's data and command. */
import { button, copy, html, save } from "../page/dom.js";
import { csvOf } from "./csv.js";

/** A choice from a list; `chosen` gets the index. */
export function choice(label, texts, at, chosen) {
  const select = html(
    "select",
    { onchange: () => chosen(select.selectedIndex) },
    ...texts.map((text, i) => html("option", { selected: i === at }, text)),
  );
  return html("label", { class: "choice" }, html("span", {}, label), select);
}

/** A button that stays pressed; `change` gets whether the button is pressed. */
export function toggle(text, on, change, title) {
  const made = button(
    text,
    () => {
      const next = made.getAttribute("aria-pressed") !== "true";
      made.setAttribute("aria-pressed", next);
      change(next);
    },
    { "aria-pressed": on, title },
  );
  return made;
}

/** Buttons for the data of a chart, and for the command that made the chart. */
export function takeAway(chart) {
  const csv = () => save(`${chart.id}.csv`, new Blob([csvOf(chart)], { type: "text/csv;charset=utf-8" }));
  const parts = [button("CSV", csv, { title: "Save the data of this chart" })];
  if (chart.command) {
    const press = (event) => copy(chart.command, event.currentTarget);
    parts.push(button("Copy command", press, { title: chart.command }));
  }
  return html("span", { class: "take-away" }, ...parts);
}
