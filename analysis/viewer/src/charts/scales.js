/** Makes d3's scales from a chart's description. */
import { scaleLinear, scaleLog, scalePoint } from "d3-scale";
import { minus, raised } from "../page/numbers.js";

/**
 * The scale of an axis, its ticks, and the function that writes a tick as text.
 * @param {"linear"|"log"|"log2"|"band"} kind
 * @param {number[]|string[]} domain two ends, or the categories
 * @param {[number, number]} range pixels
 * @param {number[]} [values] possible ticks: the values of a sweep
 * @param {number} [gap] the least distance of ticks in px
 */
export function axisScale(kind, domain, range, values, gap = 64) {
  if (kind === "band") {
    const scale = scalePoint(domain, range).padding(0.6);
    return { kind, scale, ticks: domain, text: (category) => String(category) };
  }
  const scale = (kind === "linear" ? scaleLinear() : scaleLog()).domain(domain).range(range);
  const count = Math.max(2, Math.floor(Math.abs(range[1] - range[0]) / gap));
  const inside = values?.filter((x) => x >= domain[0] && x <= domain[1]);
  if (inside && inside.length > 1 && inside.length <= 24) {
    return { kind, scale, ticks: spaced(inside, scale, gap * 0.55), text: plain };
  }
  if (kind === "linear") return { kind, scale, ticks: scale.ticks(count), text: plain };
  return { kind, scale, ticks: spaced(logTicks(domain, count), scale, gap * 0.55), text: logText };
}

/** px. A narrower chart is not drawn, because the browser is still laying out the page. */
export const LEAST_WIDTH = 160;
/** px. In a narrower chart the names of rows are above the rows. */
export const NARROW = 560;

const LEAST = 1e-6; // share of the largest number; smaller numbers are rounding and would stretch a log axis

/** The ends of an axis: the range of the numbers, and some room. `log`: only positive numbers
 * count, and the room is a factor. `zero`: an axis that would begin near zero begins at zero. */
export function extent(numbers, log, room = 0.06, zero = true) {
  const fine = numbers.filter((x) => Number.isFinite(x) && (!log || x > 0));
  if (!fine.length) return log ? [0.1, 1] : [0, 1];
  let low = Math.min(...fine),
    high = Math.max(...fine);
  if (log) {
    low = Math.max(low, high * LEAST);
    const factor = Math.max((high / low) ** room, low === high ? 1.5 : 1.02);
    return [low / factor, high * factor];
  }
  const space = (high - low) * room || Math.abs(high) * 0.1 || 0.5;
  if (zero && low >= 0 && low - space < 0.25 * high) return [0, high + space]; // near zero the axis starts at zero
  return [low - space, high + space];
}

// Round multiples of powers of ten, as many as there is room for.
function logTicks([low, high], count) {
  const decades = Math.log10(high / low);
  const within = (most, share) => decades < Math.min(most, share * count);
  const leading = within(1.4, 0.28) ? [1, 2, 3, 5, 7] : within(3, 0.55) ? [1, 2, 5] : [1];
  const every = Math.max(1, Math.ceil(decades / count));
  const ticks = [];
  for (let exponent = Math.floor(Math.log10(low)); exponent <= Math.ceil(Math.log10(high)); ++exponent) {
    if (leading.length === 1 && exponent % every) continue;
    for (const first of leading) {
      const tick = first * 10 ** exponent;
      if (tick >= low * 0.9999 && tick <= high * 1.0001) ticks.push(Number(tick.toPrecision(1)));
    }
  }
  if (ticks.length >= 2) return ticks;
  return scaleLinear().domain([low, high]).ticks(count);
}

// Leaves out values, so that ticks are at least `gap` px apart.
function spaced(values, scale, gap) {
  const kept = [];
  for (const x of [...values].sort((a, b) => a - b)) {
    if (!kept.length || Math.abs(scale(x) - scale(kept.at(-1))) >= gap) kept.push(x);
  }
  return kept;
}

function plain(x) {
  const size = Math.abs(x);
  if (size >= 1e5 || (size > 0 && size < 1e-3)) return logText(x);
  return minus(String(Number(x.toPrecision(6))));
}

function logText(x) {
  if (x >= 1e-3 && x < 1e5) return minus(String(Number(x.toPrecision(3))));
  const [first, exponent] = x.toExponential(2).split("e").map(Number);
  return first === 1 ? `10${raised(exponent)}` : `${minus(String(first))}·10${raised(exponent)}`;
}
