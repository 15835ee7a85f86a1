/** The dimensions along which the explorer compares runs: the axes of sweeps, and the metrics. */
import { pageData } from "../page/data.js";
import { value } from "../page/numbers.js";

const DECADE = 10; // numbers whose largest is at least this many times the smallest get a logarithmic scale

/**
 * @typedef {Object} Dimension
 * @property {string} name pointer of a setting, or name of a number
 * @property {string} label @property {string} unit @property {string} meaning
 * @property {string[]|null} texts the values of an axis, in order
 * @property {Object[]|null} looks of these values
 * @property {"band"|"linear"|"log"} scale
 * @property {(run: Object) => number} of the run's number, or the index of its text; NaN: the run has none
 * @property {(run: Object) => string|null} text of a run's value on an axis
 */

/** @returns {{axes: Dimension[], numbers: Dimension[]}} */
export function dimensions() {
  const { explorer, runs, summary } = pageData();
  const axes = explorer.axes.map((axis, at) => {
    const place = (run) => explorer.places[run.id]?.[at] ?? null;
    const ofRun = (run) => {
      const found = place(run);
      return found === null ? NaN : axis.numbers ? axis.numbers[found] : found;
    };
    const scale = axis.numbers ? scaleOf(axis.numbers) : "band";
    return { ...axis, of: ofRun, scale, text: (run) => axis.texts[place(run)] ?? null };
  });
  const numbers = explorer.numbers.map((name) => {
    const ofRun = (run) => value(run.summary?.[name]);
    return { name, ...summary[name], texts: null, looks: null, of: ofRun, scale: scaleOf(runs.map(ofRun)) };
  });
  return { axes, numbers };
}

function scaleOf(values) {
  const known = values.filter(Number.isFinite);
  const low = Math.min(...known);
  return known.length && low > 0 && Math.max(...known) >= DECADE * low ? "log" : "linear";
}
