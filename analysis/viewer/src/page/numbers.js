/** Numbers as text, as analysis/tables/numbers.py writes them: 3 significant digits, – for no number. */

/** @param {number|string|null|undefined} value "∞" stands for infinity, which JSON does not have */
export function value(value) {
  if (value === "∞") return Infinity;
  if (value === "-∞") return -Infinity;
  return typeof value === "number" ? value : NaN;
}

/** @param {number} x @param {number} [digits] significant digits */
export function number(x, digits = 3) {
  if (Number.isNaN(x)) return "–";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e5 || size < 1e-3) {
    const [mantissa, exponent] = x.toExponential(digits - 1).split("e");
    return `${minus(mantissa)}·10${raised(Number(exponent))}`;
  }
  const places = Math.max(digits - 1 - Math.floor(Math.log10(size)), 0);
  return minus(x.toFixed(places));
}

/** A number with its unit; the unit of a plain ratio, "1", is not written. */
export function withUnit(x, unit, digits) {
  return unit && unit !== "1" ? `${number(x, digits)}\u202f${unit}` : number(x, digits);
}

/** An axis title: "mean strain", "drop (m)". */
export function titled(label, unit) {
  return unit && unit !== "1" ? `${label} (${unit})` : label;
}

export const minus = (text) => text.replace("-", "−");

/** An exponent in raised digits. */
export function raised(exponent) {
  return String(exponent).replace(/[-\d]/g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]));
}
