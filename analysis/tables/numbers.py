"""Numbers as text for tables and pages, and as values for JSON."""
import math

import numpy as np

RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value, digits=3):
    """A number as text: `digits` significant digits, no exponent from 0.001 to 10⁵, – for NaN or None."""
    if value is None or math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    if value == 0:
        return "0"
    if abs(value) >= 1e5 or abs(value) < 1e-3:
        return f"{value:.{digits - 1}e}"
    places = max(digits - 1 - math.floor(math.log10(abs(value))), 0)
    return f"{value:.{places}f}"


def number_text(value, digits=3):
    """A number as text of a page: 0.00123, 1.23·10⁻⁵, − for negative numbers."""
    first, _, exponent = number(value, digits).replace("-", "−", 1 if (value or 0) < 0 else 0).partition("e")
    return f"{first}·10{str(int(exponent)).translate(RAISED)}" if exponent else first


def span(values, digits=3):
    """The range of numbers as text, '1.30 to 8.40'; one number if both ends round to the same text."""
    low, high = number(min(values), digits), number(max(values), digits)
    return low if low == high else f"{low} to {high}"


def percents(shares):
    """The range of shares in whole percent, '98 to 104'; one number if both ends round to the same text."""
    return " to ".join(dict.fromkeys(f"{100 * end:.0f}" for end in (min(shares), max(shares))))


def finite(values):
    """The list of the values that are finite numbers."""
    return [value for value in values if math.isfinite(value)]


def slope(x, y):
    """Exponent p of y ∝ x^p, by least squares of the logarithms. NaN for fewer than two points."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    known = np.isfinite(x) & np.isfinite(y) & (x > 0) & (y > 0)
    return float(np.polyfit(np.log(x[known]), np.log(y[known]), 1)[0]) if known.sum() > 1 else np.nan


def unit_text(unit):
    """A unit as text after a number; "" for numbers without unit."""
    return "" if unit == "1" else f" {unit}"


def evenly(count, most):
    """The indices of at most `most` of `count` entries of a list, at even intervals."""
    return np.unique(np.linspace(0, count - 1, most).round().astype(int))


def shortened(value, digits=5):
    """A number for the data of a page: rounded, None for NaN, "∞" for infinite numbers."""
    if value is None or math.isnan(value):
        return None
    if math.isinf(value):
        return "∞" if value > 0 else "-∞"
    return float(f"{value:.{digits}g}")


def rounded(value, digits=4):
    """A value with all numbers rounded to `digits` significant digits, also inside lists and dictionaries.
    NaN becomes None; infinite numbers become "inf" and "-inf"."""
    if isinstance(value, dict):
        return {str(key): rounded(entry, digits) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(entry, digits) for entry in value]
    if isinstance(value, bool) or value is None or isinstance(value, (str, int)):
        return value
    value = float(value)
    if math.isnan(value):
        return None
    return float(f"{value:.{digits}g}") if math.isfinite(value) else str(value)


def known(value):
    """The number that rounded() turned into this value: NaN for None, an infinite number for "inf"."""
    if value is None:
        return math.nan
    return float(value) if value in ("inf", "-inf") else value


def known_values(numbers):
    """Applies known() to every value of a dictionary."""
    return {name: known(value) for name, value in numbers.items()}
