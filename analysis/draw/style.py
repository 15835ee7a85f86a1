"""The style of figures that matplotlib draws: fonts, colours, axes and files."""
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap, LogNorm
from matplotlib.ticker import LogLocator, NullLocator
from PIL import Image

from tables.looks import INK

GREY, GRID = "#6d747c", "#dfe3e7"

LARGE = 290_000  # bytes; a larger picture gets 256 colours
SHADES = 3  # steps of 1/255 between shades; this step is invisible, and makes a file a third smaller
STRETCH = LinearSegmentedColormap.from_list("stretch",
                                            ["#ece7dc", "#f4cd73", "#ea7a3c", "#bb1b4f", "#42104f"])
STRETCH_NORM = LogNorm(0.01, 10)  # sigma_1 - 1, shared by every picture

plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 9, "axes.titlesize": 9.5, "axes.labelsize": 9,
                     "legend.fontsize": 8.5, "xtick.labelsize": 8.5, "ytick.labelsize": 8.5,
                     "axes.edgecolor": GREY, "axes.labelcolor": INK, "text.color": INK, "xtick.color": GREY,
                     "ytick.color": GREY, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
                     "axes.titlecolor": INK, "axes.spines.top": False, "axes.spines.right": False,
                     "axes.grid": True, "grid.color": GRID, "grid.linewidth": 0.7, "axes.axisbelow": True,
                     "legend.frameon": False, "lines.linewidth": 1.6, "lines.markersize": 5.5,
                     "figure.dpi": 150, "savefig.dpi": 150, "axes.titlelocation": "left",
                     "pdf.fonttype": 42})  # texts of a PDF stay texts


def plain_log(axes, which="y"):
    """Makes an axis logarithmic, with ticks like 0.2, 0.5, 1, and powers only below 0.001 and from 10⁴. Call
    this after drawing."""
    axes.set(**{f"{which}scale": "log"})
    axis = getattr(axes, f"{which}axis")
    low, high = axis.get_view_interval()
    decades = np.log10(high / low)
    subs = (1, 2, 5) if decades < 1.6 else (1, 3) if decades < 2.6 else (1,)
    axis.set_major_locator(LogLocator(subs=subs, numticks=20))
    axis.set_major_formatter(lambda value, _: _log_text(value))
    axis.set_minor_locator(NullLocator())


def _log_text(value):
    if 1e-3 <= value < 1e4:
        return f"{value:,.0f}" if value >= 1000 else f"{value:g}"
    factor, power = f"{value:.0e}".split("e")
    return ("" if factor == "1" else rf"{factor}$\cdot$") + f"$10^{{{int(power)}}}$"


_with_pdf = False


def print_as_pdf(wanted):
    """Sets whether save() also writes a PDF file of every figure."""
    global _with_pdf
    _with_pdf = wanted


def save(figure, folder, name, palette=True, dpi=None, tight=True, large=LARGE):
    """Writes folder/name.png (after print_as_pdf(True) also name.pdf), and returns the file name of the PNG.
    `tight` removes empty margins.

    A picture of more than `large` bytes is reduced to 256 colours. Smooth shading would then show steps; use
    `palette` = False for such pictures, which rounds shades to multiples of SHADES instead.
    """
    path = Path(folder) / f"{name}.png"
    path.parent.mkdir(parents=True, exist_ok=True)
    how = dict(bbox_inches="tight" if tight else None, pad_inches=0.08, facecolor="white",
               dpi=dpi or "figure")
    figure.savefig(path, **how, pil_kwargs={"optimize": True})
    if _with_pdf:
        figure.savefig(path.with_suffix(".pdf"), **how, metadata={"CreationDate": None})
    plt.close(figure)
    if path.stat().st_size <= large:
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
    """256 colours that suit the colour map of stretch and every third pixel of each row and column."""
    image = image.resize((image.width // 3, image.height // 3), Image.Resampling.NEAREST)
    strip = (255 * STRETCH(np.linspace(0, 1, image.width))[None, :, :3]).astype(np.uint8)
    both = np.concatenate([np.asarray(image), strip.repeat(image.height // 8, axis=0)])
    return Image.fromarray(both).quantize(256, method=Image.Quantize.MEDIANCUT, kmeans=2)
