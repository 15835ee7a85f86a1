/** The visible points of a chart: of shown series, at the chosen values of `held` axes, with a number. */
import { value } from "../page/numbers.js";

/**
 * @param {Object} chart as in the page's data
 * @param {{metric: number, held: number[], hidden: Set<string>}} state
 * @returns {{series: Object, points: Object[]}[]} points have x, y, low, high, runs; y is infinite
 *   for a run that diverged
 */
export function shownPoints(chart, { metric, held, hidden }) {
  const name = chart.ys[metric].name;
  return chart.series
    .filter((series) => !hidden.has(series.label) && series.y[name])
    .filter((series) => (series.held ?? []).every((at, axis) => at === null || at === held[axis]))
    .map((series) => ({
      series,
      points: series.x.map((x, i) => point(series, name, x, i)).filter((p) => !Number.isNaN(p.y)),
    }))
    .filter(({ points }) => points.length);
}

function point(series, name, x, i) {
  const y = value(series.y[name][i]);
  const part = (numbers) => {
    const found = value(numbers?.[name]?.[i]);
    return Number.isNaN(found) ? y : found;
  };
  const runs = series.runs?.[i] ?? (series.run ? [series.run] : []);
  return { series, i, x, y, low: part(series.low), high: part(series.high), runs };
}
