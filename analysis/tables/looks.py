"""The style (`look`) of models, methods and other series, on pages and in figures: colour, mark and line.

Each family of bending models has a kind of mark: springs a filled circle, hinges an open polygon, springs
that push a filled plus, no bending a cross. Models and methods get their colours in the order in which the
program lists them. So a model or method has the same colour on all pages, also if it is new.
"""
import colorsys

from matplotlib.colors import to_rgb

from bendlab.results import registry

# In the order of the program's models. Springs among the first twelve have the palette of Okabe and Ito. With
# any colour vision, people can tell apart the colours of hinges, and can tell colours after the first twelve
# from all others.
MODEL_COLOURS = ["#7f7f7f", "#d55e00", "#009e73", "#0072b2", "#cc79a7", "#e69f00", "#c2185b", "#000000",
                 "#8a4b08", "#5b3fa0", "#56b4e9", "#a3a500", "#a500ff", "#4b004b", "#0f3c1e", "#0f0069",
                 "#87b469", "#9687ff", "#783c78", "#6900b4"]
# (mark, dash) of the models in each family. Curves of hinges often coincide, so their dashes differ.
FAMILY_LOOKS = {"no bending": [("X", "2 4")], "springs": [("o", None)],
                "springs that push": [("P", "8 4 2 4")],
                "hinges": [("s", None), ("D", "4 5"), ("^", "4 5"), ("v", "7 5")]}
# In the order of the program's methods: (colour of the method, colour of the method with a setting that a
# figure shows separately).
METHOD_COLOURS = [("#d55e00", "#e69f00"), ("#5b3fa0", "#a500ff"), ("#000000", "#7f7f7f"),
                  ("#009e73", "#8a4b08"), ("#0072b2", "#56b4e9"), ("#cc79a7", "#c2185b"),
                  ("#a3a500", "#4b004b"), ("#0f3c1e", "#87b469"), ("#0f0069", "#9687ff"),
                  ("#783c78", "#6900b4")]
METHOD_MARKS = [("o", "X"), ("D", "s"), ("X", "o"), ("^", "v"), ("s", "D"), ("P", "X")]
SEQUENCE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b6b6b"]
INK = "#22262b"  # of text, and of theory
VARIANTS = [None, "7 4", "2 4", "8 4 2 4"]  # dashes of series that differ in one setting

GROUNDS = {"light": "#ffffff", "dark": "#14171a"}  # --paper of viewer/src/page/page.css
# smallest contrast of lines and marks with the background; WCAG 2.2 requires 3
CONTRAST = {"light": 3.0, "dark": 4.5}
MARKS = ["o", "s", "D", "^", "v", "P", "X"]


def model_name(model, k=None):
    """The name of a bending model as the program writes it; the model k_ring with its k."""
    return model + (f", k = {k}" if model == "k_ring" and k else "")


def family(model):
    """The family of a model, a key of FAMILY_LOOKS. Models of a family have similar marks and lines."""
    if registry.is_prestressed(model):
        return "springs that push"
    return {"nothing": "no bending", "hinges": "hinges"}.get(registry.made_of(model), "springs")


def _at(looks, place):
    return looks[place % len(looks)]


def _further(place, lightness):
    """A colour for a place after the end of a list of colours: hues differ by a golden angle."""
    return _hex(place * 0.618034 % 1, lightness, 0.6)


def _method_colours(place):
    """The two colours of a method."""
    if place < len(METHOD_COLOURS):
        return METHOD_COLOURS[place]
    return tuple(_further(place, lightness) for lightness in (0.35, 0.6))


def colour(model):
    """The colour of a model."""
    place = registry.model_place(model)
    return MODEL_COLOURS[place] if place < len(MODEL_COLOURS) else _further(place, 0.4)


def method_look(method, variant=0):
    """(colour, marker) of a solver method. `variant` 1: with a setting that a figure shows separately."""
    place = registry.method_place(method)
    return _method_colours(place)[variant], _at(METHOD_MARKS, place)[variant]


def of_model(model):
    """The style of a bending model: the kind of mark of its family, and the colour of the model."""
    own = family(model)
    earlier = registry.models()[:registry.model_place(model)]
    mark, dash = _at(FAMILY_LOOKS[own], sum(family(other) == own for other in earlier))
    return of_look(colour(model), mark, own == "hinges", dash)


def of_method(name):
    """The style of a solver method. `name`: the text of Run.method, with the integrator after a comma."""
    method, _, variant = name.partition(", ")
    return of_look(*method_look(method, bool(variant)))


def variant(look, number):
    """The style of a variant of a series, by the variant's number: another dash, and a hollow mark in place
    of a filled mark or the other way round. The variant 0 is the series itself."""
    dash = _at(VARIANTS, number)
    return look | {"dash": dash, "hollow": not look.get("hollow")} if dash else look


def line():
    """The style of a line of theory."""
    return of_look(INK, "o")


def of_place(number):
    """The style of a series by its number in a list."""
    round_ = number // len(SEQUENCE)
    return of_look(_at(SEQUENCE, number), _at(MARKS, number), round_ % 2 == 1, _at(VARIANTS[:3], round_))


def of_look(colour, mark, hollow=False, dash=None):
    """The style of a series with this colour, mark (one of MARKS) and dash."""
    look = {name: readable(colour, ground, CONTRAST[name]) for name, ground in GROUNDS.items()}
    return look | {"mark": mark} | ({"hollow": True} if hollow else {}) | ({"dash": dash} if dash else {})


def readable(colour, ground, least):
    """The colour, made lighter or darker until it has enough contrast with the background; the hue stays. A
    grey without enough contrast is inverted before: black becomes almost white."""
    parts = to_rgb(colour)
    hue, light, full = colorsys.rgb_to_hls(*parts)
    if contrast(colour, ground) < least and max(parts) - min(parts) < 0.1:
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
    """The contrast of two colours, from 1 to 21: a ratio of their luminances (WCAG)."""
    low, high = sorted((luminance(colour), luminance(ground)))
    return (high + 0.05) / (low + 0.05)


def luminance(colour):
    """Relative luminance of an sRGB colour (WCAG)."""
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in to_rgb(colour)]
    return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), linear))
