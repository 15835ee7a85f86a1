/** A chart's data as CSV: one row per point of every series, hidden series too. */
import { value } from "../page/numbers.js";

/** @param {Object} chart as in the page's data @returns {string} */
export function csvOf(chart) {
  return chart.kind === "bars" ? barsCsv(chart) : linesCsv(chart);
}

function linesCsv(chart) {
  const held = chart.held ?? [];
  const spread = chart.series.some((series) => series.low);
  const columns = chart.ys.flatMap((y) => (spread ? [y.name, `${y.name}_low`, `${y.name}_high`] : [y.name]));
  const rows = [["series", ...held.map((axis) => axis.name), chart.x.name, ...columns, "runs"]];
  for (const series of chart.series) {
    const place = held.map((axis, i) => axis.values[series.held[i]]);
    series.x.forEach((x, i) => {
      const numbers = chart.ys.flatMap(({ name }) => {
        const parts = [series.y[name]?.[i]];
        if (spread) parts.push(series.low?.[name]?.[i] ?? parts[0], series.high?.[name]?.[i] ?? parts[0]);
        return parts.map(value).map(text);
      });
      const runs = Array.isArray(series.runs?.[i]) ? series.runs[i].join(" ") : (series.run ?? "");
      rows.push([series.label, ...place, chart.x.categories?.[x] ?? x, ...numbers, runs]);
    });
  }
  return written(rows);
}

function barsCsv(chart) {
  const rows = [["row", ...chart.parts.map((part) => `${part.label} (${chart.x.unit})`), "runs"]];
  for (const row of chart.rows) rows.push([row.label, ...row.values.map(text), (row.runs ?? []).join(" ")]);
  return written(rows);
}

function text(number) {
  return Number.isNaN(number) ? "" : Number.isFinite(number) ? String(number) : number > 0 ? "inf" : "-inf";
}

// A text that a spreadsheet would take for a formula gets an apostrophe before it.
function cell(content) {
  let text = String(content ?? "");
  if (/^[=+@\t\r]|^-[^\d.]/.test(text)) text = `'${text}`;
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

const written = (rows) => rows.map((row) => row.map(cell).join(",")).join("\n") + "\n";
