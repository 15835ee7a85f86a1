"""Numbers as text for tables and pages, and as values for JSON."""
import math

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
