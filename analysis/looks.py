"""Colours, marks and dashes of series in pages: those of style.py, light or dark enough for their ground."""
import colorsys

import style

GROUNDS = {"light": "#ffffff", "dark": "#14171a"}  # --paper of viewer/src/page/page.css
CONTRAST = {"light": 3.0, "dark": 4.5}  # least, of lines and marks to their ground; WCAG 2.2 asks for 3
MARKS = ["o", "s", "D", "^", "v", "P", "X"]
DASHES = {":": "2 4", "-.": "8 4 2 4", "--": "7 5"}  # matplotlib's names → SVG


def of_model(model):
    """How a bending model's series is drawn: its family's kind of mark, its own colour."""
    (mark, _), line = style.mark_and_line(model)
    dash = "4 5" if isinstance(line, tuple) else DASHES.get(line)
    return of_look(style.colour(model), mark, style.family(model) == "hinges", dash)


def of_place(number):
    """How the series of a place in a list is drawn."""
    colours, round_ = style.SEQUENCE, number // len(style.SEQUENCE)
    return of_look(colours[number % len(colours)], MARKS[number % len(MARKS)], bool(round_ % 2),
                 [None, "7 4", "2 4"][round_ % 3])


def of_look(colour, mark, hollow=False, dash=None):
    """How a series of this colour, mark (one of MARKS) and dash is drawn."""
    look = {name: readable(colour, ground, CONTRAST[name]) for name, ground in GROUNDS.items()}
    return look | {"mark": mark} | ({"hollow": True} if hollow else {}) | ({"dash": dash} if dash else {})


def readable(colour, ground, least):
    """The colour made lighter or darker until it has enough contrast to the ground; its hue stays. A grey
    without it is mirrored: black becomes white."""
    red, green, blue = _rgb(colour)
    hue, light, full = colorsys.rgb_to_hls(red, green, blue)
    if contrast(colour, ground) < least and max(red, green, blue) - min(red, green, blue) < 0.1:
        light = 0.93 - light
        colour = _hex(hue, light, full)
    step = -0.01 if luminance(ground) > 0.5 else 0.01
    while contrast(colour, ground) < least and 0 < light + step < 1:
        light += step
        colour = _hex(hue, light, full)
    return colour


def _hex(hue, light, full):
    return "#" + "".join(f"{round(255 * part):02x}" for part in colorsys.hls_to_rgb(hue, light, full))


def contrast(one, other):
    """Ratio of two colours' luminances, 1 to 21 (WCAG)."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def luminance(colour):
    """Relative luminance of an sRGB colour (WCAG)."""
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in _rgb(colour)]
    return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), linear))


def _rgb(colour):
    digits = colour.lstrip("#")
    digits = "".join(2 * digit for digit in digits) if len(digits) == 3 else digits
    return [int(digits[i:i + 2], 16) / 255 for i in (0, 2, 4)]
