"""The look of every figure: fonts, colours, marks, labels, number formats, and how cloth is drawn in a panel.

A family of bending models has a kind of mark: springs are filled circles, hinges are open polygons, springs
that push a filled plus, no bending a cross. Models and methods have their colours in the order in which the
program lists them, so that each has one on all pages, a new one too.
"""
import colorsys
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap, LogNorm, to_hex
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator
from PIL import Image

from bendlab.results import registry
import render

# In the order of the program's models. The springs among the first twelve have the palette of Okabe and Ito,
# the hinges colours between which all kinds of sight distinguish, and so do the others between all.
MODEL_COLOURS = ["#7f7f7f", "#d55e00", "#009e73", "#0072b2", "#cc79a7", "#e69f00", "#c2185b", "#000000",
                 "#8a4b08", "#5b3fa0", "#56b4e9", "#a3a500", "#a500ff", "#4b004b", "#0f3c1e", "#0f0069",
                 "#87b469", "#9687ff", "#783c78", "#6900b4"]
# The marks (size in points) and lines of a family's models. Hinges often coincide: their marks are nested and
# their lines are dashes over a solid one.
FAMILY_MARKS = {"no bending": [("X", 5)], "springs": [("o", 4)], "springs that push": [("P", 6)],
                "hinges": [("s", 8), ("D", 5.5), ("^", 4), ("v", 6)]}
FAMILY_LINES = {"no bending": [":"], "springs": ["-"], "springs that push": ["-."],
                "hinges": ["-", (0, (4, 8)), (6, (4, 8)), "--"]}
# In the order of the program's methods: as it is, and with a setting that a figure tells apart.
METHOD_COLOURS = [("#d55e00", "#e69f00"), ("#5b3fa0", "#a500ff"), ("#000000", "#7f7f7f"),
                  ("#009e73", "#8a4b08"), ("#0072b2", "#56b4e9"), ("#cc79a7", "#c2185b"),
                  ("#a3a500", "#4b004b"), ("#0f3c1e", "#87b469"), ("#0f0069", "#9687ff"),
                  ("#783c78", "#6900b4")]
METHOD_MARKS = [("o", "X"), ("D", "s"), ("X", "o"), ("^", "v"), ("s", "D"), ("P", "X")]
INK, GREY, GRID = "#22262b", "#6d747c", "#dfe3e7"
SEQUENCE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b6b6b"]

PRINT = "--pdf"  # an option of every script that draws, so that processes it starts know it, too
LARGE = 290_000  # bytes; a larger picture gets a palette
SHADES = 3  # of 255; invisible steps that make a file a third smaller
STRETCH = LinearSegmentedColormap.from_list("stretch",
                                            ["#ece7dc", "#f4cd73", "#ea7a3c", "#bb1b4f", "#42104f"])
STRETCH_NORM = LogNorm(0.01, 10)  # sigma_1 - 1, shared by every picture

LEFT, RIGHT = dict(xy=(0.03, 0.975), ha="left"), dict(xy=(0.97, 0.975), ha="right")  # corners for the time
TORN = 0.5  # mean strain; a sheet with more is no cloth
REST = 0.01  # sizes per second (root mean square of the vertices' speeds); a slower cloth is at rest
LABEL = dict(boxstyle="round,pad=0.25", fc="white", ec="none", alpha=0.72)  # behind text on a picture

plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 9, "axes.titlesize": 9.5, "axes.labelsize": 9,
                     "legend.fontsize": 8.5, "xtick.labelsize": 8.5, "ytick.labelsize": 8.5,
                     "axes.edgecolor": GREY, "axes.labelcolor": INK, "text.color": INK, "xtick.color": GREY,
                     "ytick.color": GREY, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
                     "axes.titlecolor": INK, "axes.spines.top": False, "axes.spines.right": False,
                     "axes.grid": True, "grid.color": GRID, "grid.linewidth": 0.7, "axes.axisbelow": True,
                     "legend.frameon": False, "lines.linewidth": 1.6, "lines.markersize": 5.5,
                     "figure.dpi": 150, "savefig.dpi": 150, "axes.titlelocation": "left",
                     "pdf.fonttype": 42})  # texts of a PDF stay texts


def model_name(model, k=None):
    """A bending model as the program writes it; of springs to rings 1 … `k` with k."""
    return model + (f", k = {k}" if model == "k_ring" and k else "")


def family(model):
    """Models of a kind, which look alike: a key of FAMILY_MARKS."""
    if registry.is_prestressed(model):
        return "springs that push"
    return {"nothing": "no bending", "hinges": "hinges"}.get(registry.made_of(model), "springs")


def _at(looks, place):
    return looks[place % len(looks)]


def _method_colours(place):
    """Beyond the list, hues a golden angle apart."""
    if place < len(METHOD_COLOURS):
        return METHOD_COLOURS[place]
    hue = place * 0.618034 % 1
    return tuple(to_hex(colorsys.hls_to_rgb(hue, lightness, 0.6)) for lightness in (0.35, 0.6))


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
    """(colour, marker) of a solver method; `variant` 1: with a setting that a figure tells apart."""
    place = registry.method_place(method)
    return _at(_method_colours(place), variant), _at(_at(METHOD_MARKS, place), variant)


def look(model, **other):
    """How a model's curve is drawn: colour, line and marks, as keywords of `plot`; `other` replaces some."""
    (mark, size), line = mark_and_line(model)
    inside = "none" if family(model) == "hinges" else colour(model)
    return dict(color=colour(model), marker=mark, markersize=size, markerfacecolor=inside, linewidth=1.3,
                linestyle=line) | other


def spread(places, heights, low=-np.inf, high=np.inf):
    """The places nearest to `places` (least squares) at which labels of these heights don't overlap.

    Their order stays, and they lie between low and high if they fit there.
    """
    order = np.argsort(places, kind="stable")
    wanted, tall = np.asarray(places, float)[order], np.asarray(heights, float)[order]
    above_first = np.concatenate([[0], np.cumsum((tall[:-1] + tall[1:]) / 2)])
    blocks = []  # (mean, count): labels that touch move as one
    for value in wanted - above_first:
        mean, count = value, 1
        while blocks and blocks[-1][0] > mean:
            other, more = blocks.pop()
            mean, count = (mean * count + other * more) / (count + more), count + more
        blocks.append((mean, count))
    first = np.concatenate([np.full(count, mean) for mean, count in blocks])
    least = low + tall[0] / 2
    result = np.empty(len(order))
    result[order] = np.clip(first, least, max(least, high - tall[-1] / 2 - above_first[-1])) + above_first
    return result


def label_ends(axes, x=1.02, only=None, size=8):
    """Writes the label of each curve beside its end, in its colour; curves that coincide share one label.

    Call it when everything is drawn, for it reads the limits. `x`: where the labels begin, as a share of the
    width. `only`: a test of labels.
    """
    axes.figure.draw_without_rendering()  # the layout decides how tall the axes are
    curves = [(handle[0] if isinstance(handle, tuple) else handle, label)
              for handle, label in zip(*axes.get_legend_handles_labels()) if only is None or only(label)]
    groups = coinciding([(_drawn(axes, line), line, label) for line, label in curves])
    if not groups:
        return
    tall = axes.get_window_extent().height * 72 / axes.figure.dpi  # points
    ends = [np.clip(_share(axes, some[0][0][-1]), 0, 1) for some in groups]
    line = 1.3 * size / tall
    for some, end, place in zip(groups, ends, spread([y for _, y in ends],
                                                     [line * len(some) for some in groups], 0, 1)):
        for i, (_, curve, label) in enumerate(some):
            colour = curve.get_color()
            axes.annotate("= " * (i > 0) + label, end, xytext=(x, place + line * ((len(some) - 1) / 2 - i)),
                          xycoords="axes fraction", textcoords="axes fraction", color=colour, fontsize=size,
                          va="center", annotation_clip=False,
                          arrowprops=dict(arrowstyle="-", color=colour, linewidth=0.6, alpha=0.7, shrinkA=0,
                                          shrinkB=4, relpos=(0, 0.5)) if i == (len(some) - 1) // 2 else None)


def coinciding(curves, tolerance=2.0):
    """Groups of curves (points, …) that lie on one another: within `tolerance` in each of their points."""
    groups = []
    for curve in curves:
        like = lambda other: (other[0].shape == curve[0].shape
                              and np.abs(other[0] - curve[0]).max(initial=0) <= tolerance)
        home = next((some for some in groups if like(some[0])), None)
        if home:
            home.append(curve)
        elif len(curve[0]):
            groups.append([curve])
    return groups


def _drawn(axes, line):
    """(n, 2) finite points of a curve, in points of the page."""
    places = axes.transData.transform(np.asarray(line.get_xydata(), float)) * 72 / axes.figure.dpi
    return places[np.isfinite(places).all(axis=1)]


def _share(axes, place):
    """A place in points of the page as shares of the axes' width and height."""
    return axes.transAxes.inverted().transform(place * axes.figure.dpi / 72)


def stretch_colours(excess):
    """(T) sigma_1 - 1 → (T, 3) sRGB. NaN gets the colour of the largest stretch."""
    excess = np.nan_to_num(np.asarray(excess, float), nan=STRETCH_NORM.vmax, posinf=STRETCH_NORM.vmax)
    return STRETCH(STRETCH_NORM(np.clip(excess, STRETCH_NORM.vmin, STRETCH_NORM.vmax)))[:, :3]


def camera_of(samples, **how):
    """One camera for all samples (run, frame) of a figure; None if there are none."""
    samples = [sample for sample in samples if sample]
    if not samples:
        return None
    runs = [run for run, _ in samples]
    rest, seeds = runs[0].rest_positions, runs[0].pin_seeds
    pin = samples[0][0].positions(samples[0][1])[seeds[0]] if len(seeds) else rest.mean(axis=0)
    return render.camera_for([run.positions(frame) for run, frame in samples], pin, runs[0].size, **how)


def cameras_of(samples, **how):
    """A camera for each sample (run, frame): one scale, at which the largest sheet that holds fills a panel.

    Each is centred on its sheet. Of a torn one it shows what is within an unstretched sheet's reach.
    """
    holds = [bool(sample) and sample[0].metrics["mean_strain"][sample[1]] < TORN for sample in samples]
    found = [camera_of([sample], reach=1.25 if held else 1.02, **how)
             for sample, held in zip(samples, holds)]
    half = lambda camera: (camera.extent[3] - camera.extent[2]) / 2
    most = max((half(camera) for camera, held in zip(found, holds) if held),
               default=max((half(camera) for camera in found if camera), default=1))
    return [camera and render.scaled(camera, most) for camera in found]


def draw_cloth(axes, sample, camera, width=420, text=None, whole=True):
    """Draws a cloth, its pins and the time in a panel. `sample`: (run, frame), or None without a run.

    `whole`: the camera shows the whole cloth, so that the panel states the share outside the frame.
    """
    axes.set_axis_off()
    if sample is None:
        axes.text(0.5, 0.5, "no run", ha="center", va="center", color=GREY, transform=axes.transAxes)
        return
    run, frame = sample
    positions, triangles = run.positions(frame), run.triangles
    excess = run.cell("max_stretch", frame) - 1
    image = render.render(positions, triangles, stretch_colours(excess), camera, width)
    height = image.shape[0]
    axes.imshow(image, interpolation="lanczos", extent=(0, width, height, 0))
    _mark_pins(axes, run, positions, camera, (height, width))
    corner = free_corner(camera.project(positions, (height, width))[0], (height, width))
    time = stamp(axes, run, frame, corner)
    if text:
        caption(axes, text)
    outside = share_outside(positions, camera, (height, width))
    if whole and outside > 0.005:
        share = f"{100 * outside:.0f}" if outside < 0.995 else "> 99"
        below = -15 - 11 * time.get_text().count("\n")  # points
        axes.annotate(f"{share} % outside", corner["xy"], xycoords="axes fraction", xytext=(0, below),
                      textcoords="offset points", fontsize=7.5, color="#8a1538", bbox=LABEL,
                      ha=corner["ha"], va="top")


def stamp(axes, run, frame, corner=LEFT):
    """Writes the time of a frame into an upper corner of a picture; returns the text."""
    return axes.annotate(time_text(run, frame).replace(", ", "\n"), xycoords="axes fraction", fontsize=8,
                         va="top", bbox=LABEL, **corner)


def free_corner(places, shape):
    """The upper corner of a picture of this shape in which fewer of the places (n, 2) lie, in pixels."""
    height, width = shape
    x, y = places.T
    high = (y > 0) & (y < 0.13 * height)
    left, right = (x > 0) & (x < 0.45 * width), (x > 0.55 * width) & (x < width)
    return RIGHT if (high & left).sum() > (high & right).sum() else LEFT


def time_text(run, frame):
    """'t = 4.0 s' of a frame, or 'at rest, t = 4.0 s' if the cloth is no faster than REST."""
    time = run.metrics["time"][frame]
    text = f"t = {time:.1f} s" if abs(time - round(time, 1)) < 1e-6 else f"t = {time:.2f} s"
    if frame == 0:
        return text
    moved = run.positions(frame) - run.positions(frame - 1)
    speed = np.sqrt((moved**2).sum(axis=1).mean()) / (time - run.metrics["time"][frame - 1])
    return f"at rest, {text}" if speed <= REST * run.size else text


def caption(axes, text, corner=LEFT):
    """Writes text in the lower left or right corner of a picture."""
    axes.text(corner["xy"][0], 0.025, text, transform=axes.transAxes, fontsize=8, ha=corner["ha"],
              va="bottom", linespacing=1.35, bbox=LABEL)


def share_outside(positions, camera, shape):
    """Share of the vertices outside the picture's frame."""
    xy, nearness = camera.project(positions, shape)
    inside = (nearness > 0) & (xy >= 0).all(axis=1) & (xy[:, 0] <= shape[1]) & (xy[:, 1] <= shape[0])
    return 1 - inside.mean()


def _mark_pins(axes, run, positions, camera, shape):
    seeds = set(run.pin_seeds.tolist())
    for vertices, size in ((np.flatnonzero(run.pinned), 5), (np.array(sorted(seeds), int), 26)):
        xy, _ = camera.project(positions[vertices], shape)
        axes.scatter(xy[:, 0], xy[:, 1], s=size, c="#111418", edgecolors="white", linewidths=0.7 if size > 9
                     else 0.25, zorder=3, clip_on=True)
    axes.set_xlim(0, shape[1])
    axes.set_ylim(shape[0], 0)


def stretch_bar(figure, axes, **how):
    """Draws the colour bar of stretch beside the given axes."""
    bar = figure.colorbar(plt.cm.ScalarMappable(STRETCH_NORM, STRETCH), ax=axes, extend="both", **how)
    bar.set_label("stretch σ₁ − 1")
    ticks = [0.01, 0.03, 0.1, 0.3, 1, 3, 10]
    bar.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    bar.ax.grid(False)
    bar.outline.set_visible(False)
    return bar


def legend_below(figure, axes, columns):
    """Draws the legend of one panel below all panels."""
    figure.legend(*axes.get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, -0.01),
                  ncol=columns)


def plain_log(axes, which="y"):
    """A logarithmic axis with ticks like 0.2, 0.5, 1 instead of powers. Call it after drawing."""
    axis = axes.yaxis if which == "y" else axes.xaxis
    (axes.set_yscale if which == "y" else axes.set_xscale)("log")
    low, high = axes.get_ylim() if which == "y" else axes.get_xlim()
    decades = np.log10(high / low)
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if decades < 1.6 else (1, 3) if decades < 2.6 else (1,),
                                      numticks=20))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}" if value >= 1000
                                           else f"{value:g}"))
    axis.set_minor_locator(NullLocator())


def resolution_axis(axes, cells):
    """Makes the x axis one of cells per side; powers of two have equal distances."""
    axes.set_xscale("log", base=2)
    axes.set_xticks(cells, labels=[str(n) for n in cells])
    axes.minorticks_off()
    axes.set_xlabel("resolution N (cells per side)")


def with_range(axes, x, spreads, label=None, shift=1.0, **look):
    """Draws a line through medians, with bars over the seeds' range. `shift` moves bars apart."""
    known = [(at * shift, s) for at, s in zip(x, spreads) if s.known]
    if not known:
        return
    at = np.array([k[0] for k in known])
    middle, low, high = (np.array([getattr(s, part) for _, s in known]) for part in ("median", "low", "high"))
    high = np.where(np.isfinite(high), high, middle * 100)
    axes.errorbar(at, middle, yerr=[middle - low, high - middle], label=label, capsize=2.5, elinewidth=1,
                  **look)


def number(value, digits=3):
    """A number as text: 3 significant digits, no exponent from 0.001 to 10⁵, – for NaN."""
    if value is None or np.isnan(value):
        return "–"
    if np.isinf(value):
        return "∞"
    if value == 0:
        return "0"
    if abs(value) >= 1e5 or abs(value) < 1e-3:
        return f"{value:.{digits - 1}e}"
    places = max(digits - 1 - int(np.floor(np.log10(abs(value)))), 0)
    return f"{value:.{places}f}"


def save(figure, folder, name, palette=True, dpi=None, tight=True):
    """Writes folder/name.png, with PRINT also name.pdf, and returns the picture's name. `tight` cuts it to
    what is drawn.

    A picture of more than LARGE bytes gets 256 colours. Smooth shading would show them as steps: with
    `palette` false its shades are rounded to multiples of SHADES instead.
    """
    path = Path(folder) / f"{name}.png"
    path.parent.mkdir(parents=True, exist_ok=True)
    how = dict(bbox_inches="tight" if tight else None, pad_inches=0.08, facecolor="white",
               dpi=dpi or "figure")
    figure.savefig(path, **how, pil_kwargs={"optimize": True})
    if PRINT in sys.argv:
        figure.savefig(path.with_suffix(".pdf"), **how, metadata={"CreationDate": None})
    plt.close(figure)
    if path.stat().st_size <= LARGE:
        return path.name
    with Image.open(path) as image:
        image = image.convert("RGB")
    if palette:
        small = image.quantize(palette=_palette(image), dither=Image.Dither.NONE)
        colours = small.getpalette()
        white = 3 * small.getpixel((0, 0))
        colours[white:white + 3] = [255, 255, 255]  # the margin stays as white as the page
        small.putpalette(colours)
    else:
        small = image.point([255 - SHADES * round((255 - shade) / SHADES) for shade in range(256)] * 3)
    small.save(path, optimize=True)
    return path.name


def _palette(image):
    """256 colours for an image and for the stretch colour map, chosen from every third pixel."""
    image = image.resize((image.width // 3, image.height // 3), Image.Resampling.NEAREST)
    strip = Image.fromarray((255 * STRETCH(np.linspace(0, 1, image.width))[None, :, :3]).astype(np.uint8))
    strip = strip.resize((image.width, image.height // 8))
    both = Image.new("RGB", (image.width, image.height + strip.height))
    both.paste(image, (0, 0))
    both.paste(strip, (0, image.height))
    return both.quantize(256, method=Image.Quantize.MEDIANCUT, kmeans=2)
