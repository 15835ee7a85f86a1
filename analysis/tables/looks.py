"""How models, methods and other series look, on pages and in figures: colour, mark, line.

A family of bending models has a kind of mark: springs are filled circles, hinges are open polygons, springs
that push a filled plus, no bending a cross. Models and methods get their colours in the order in which the
program lists them. So each has the same colour on all pages, also a new model or method.
"""
import colorsys

from bendlab.results import registry

# In the order of the program's models. Of the first twelve, springs have the palette of Okabe and Ito. Hinges
# differ from each other, and all further colours from all, for people with any colour vision.
MODEL_COLOURS = ["#7f7f7f", "#d55e00", "#009e73", "#0072b2", "#cc79a7", "#e69f00", "#c2185b", "#000000",
                 "#8a4b08", "#5b3fa0", "#56b4e9", "#a3a500", "#a500ff", "#4b004b", "#0f3c1e", "#0f0069",
                 "#87b469", "#9687ff", "#783c78", "#6900b4"]
# The marks (size in points) and lines of a family's models. Hinges often coincide: their marks are nested and
# their lines are dashes over a solid one.
FAMILY_MARKS = {"no bending": [("X", 5)], "springs": [("o", 4)], "springs that push": [("P", 6)],
                "hinges": [("s", 8), ("D", 5.5), ("^", 4), ("v", 6)]}
FAMILY_LINES = {"no bending": [":"], "springs": ["-"], "springs that push": ["-."],
                "hinges": ["-", (0, (4, 8)), (6, (4, 8)), "--"]}
# In the order of the program's methods: colour of the method, and of the method with a setting that a figure
# shows apart.
METHOD_COLOURS = [("#d55e00", "#e69f00"), ("#5b3fa0", "#a500ff"), ("#000000", "#7f7f7f"),
                  ("#009e73", "#8a4b08"), ("#0072b2", "#56b4e9"), ("#cc79a7", "#c2185b"),
                  ("#a3a500", "#4b004b"), ("#0f3c1e", "#87b469"), ("#0f0069", "#9687ff"),
                  ("#783c78", "#6900b4")]
METHOD_MARKS = [("o", "X"), ("D", "s"), ("X", "o"), ("^", "v"), ("s", "D"), ("P", "X")]
SEQUENCE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b6b6b"]
INK = "#22262b"  # of text, and of theory
VARIANTS = [None, "7 4", "2 4", "8 4 2 4"]  # dashes of series that differ in one setting

GROUNDS = {"light": "#ffffff", "dark": "#14171a"}  # --paper of viewer/src/page/page.css
# smallest contrast of lines and marks with their ground; WCAG 2.2 asks for 3
CONTRAST = {"light": 3.0, "dark": 4.5}
MARKS = ["o", "s", "D", "^", "v", "P", "X"]
DASHES = {":": "2 4", "-.": "8 4 2 4", "--": "7 5"}  # matplotlib's names → SVG


def model_name(model, k=None):
    """The name of a bending model as the program writes it; for springs to rings 1 … `k` with k."""
    return model + (f", k = {k}" if model == "k_ring" and k else "")


def family(model):
    """The family of a model, a key of FAMILY_MARKS. Models of a family look alike."""
    if registry.is_prestressed(model):
        return "springs that push"
    return {"nothing": "no bending", "hinges": "hinges"}.get(registry.made_of(model), "springs")


def _at(looks, place):
    return looks[place % len(looks)]


def _method_colours(place):
    """The two colours of a method; beyond the list, hues a golden angle apart."""
    if place < len(METHOD_COLOURS):
        return METHOD_COLOURS[place]
    hue = place * 0.618034 % 1
    return tuple(_hex(hue, lightness, 0.6) for lightness in (0.35, 0.6))


def colour(model):
    """The colour of a model."""
    return _at(MODEL_COLOURS, registry.model_place(model))


def mark_and_line(model):
    """((marker, size in points), line style) of a model."""
    earlier = registry.models()[:registry.model_place(model)]
    place = sum(family(other) == family(model) for other in earlier)
    return _at(FAMILY_MARKS[family(model)], place), _at(FAMILY_LINES[family(model)], place)


def marker(model):
    """The mark of a model in a scatter plot."""
    return mark_and_line(model)[0][0]


def method_look(method, variant=0):
    """(colour, marker) of a solver method; `variant` 1: with a setting that a figure shows apart."""
    place = registry.method_place(method)
    return _at(_method_colours(place), variant), _at(_at(METHOD_MARKS, place), variant)


def of_model(model):
    """How a bending model's series is drawn: its family's kind of mark, its own colour."""
    (mark, _), line = mark_and_line(model)
    dash = "4 5" if isinstance(line, tuple) else DASHES.get(line)
    return of_look(colour(model), mark, family(model) == "hinges", dash)


def of_method(name):
    """How a solver method's series is drawn. `name`: as Run.method gives it, its integrator after a comma."""
    method, _, variant = name.partition(", ")
    return of_look(*method_look(method, bool(variant)))


def of_variant(number):
    """What the look of a series has in addition at this place in a list of variants."""
    dash = VARIANTS[number % len(VARIANTS)]
    return {"dash": dash, "hollow": True} if dash else {}


def line():
    """How a line of theory is drawn."""
    return of_look(INK, "o")


def of_place(number):
    """How the series of a place in a list is drawn."""
    colours, round_ = SEQUENCE, number // len(SEQUENCE)
    return of_look(colours[number % len(colours)], MARKS[number % len(MARKS)], bool(round_ % 2),
                 [None, "7 4", "2 4"][round_ % 3])


def of_look(colour, mark, hollow=False, dash=None):
    """How a series of this colour, mark (one of MARKS) and dash is drawn."""
    look = {name: readable(colour, ground, CONTRAST[name]) for name, ground in GROUNDS.items()}
    return look | {"mark": mark} | ({"hollow": True} if hollow else {}) | ({"dash": dash} if dash else {})


def readable(colour, ground, least):
    """The colour, made lighter or darker until it has enough contrast with the ground; its hue stays. A grey
    without enough contrast is first mirrored: black becomes white."""
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


def contrast(colour, ground):
    """Ratio of two colours' luminances, 1 to 21 (WCAG)."""
    low, high = sorted((luminance(colour), luminance(ground)))
    return (high + 0.05) / (low + 0.05)


def luminance(colour):
    """Relative luminance of an sRGB colour (WCAG)."""
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in _rgb(colour)]
    return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), linear))


def _rgb(colour):
    digits = colour.lstrip("#")
    digits = "".join(2 * digit for digit in digits) if len(digits) == 3 else digits
    return [int(digits[i:i + 2], 16) / 255 for i in (0, 2, 4)]
