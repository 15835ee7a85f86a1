"""Draws cloth in the panels of a figure, with cameras, colours of stretch, time and pins."""
from dataclasses import dataclass, field

import matplotlib.pyplot as plt
import numpy as np

from draw import render, style
from draw.style import GREY, STRETCH, STRETCH_NORM

LEFT, RIGHT = dict(xy=(0.03, 0.975), ha="left"), dict(xy=(0.97, 0.975), ha="right")  # corners for the time
TORN = 0.5  # mean strain; a sheet with a larger strain is torn
REST = 0.01  # sizes per second (root mean square of the vertices' speeds); a slower cloth is at rest
LABEL = dict(boxstyle="round,pad=0.25", fc="white", ec="none", alpha=0.72)  # behind text on a picture


def stretch_colours(excess):
    """The colours of triangles: (T) σ₁ - 1 → (T, 3) sRGB. NaN gets the colour of the largest stretch."""
    excess = np.nan_to_num(np.asarray(excess, float), nan=STRETCH_NORM.vmax, posinf=STRETCH_NORM.vmax)
    return STRETCH(STRETCH_NORM(np.clip(excess, STRETCH_NORM.vmin, STRETCH_NORM.vmax)))[:, :3]


def camera_of(samples, **how):
    """One camera for all samples (run, frame) of a figure. None without samples."""
    samples = [sample for sample in samples if sample]
    if not samples:
        return None
    run, frame = samples[0]
    seeds = run.pin_seeds
    pin = run.positions(frame)[seeds[0]] if len(seeds) else run.rest_positions.mean(axis=0)
    return render.camera_for([run.positions(frame) for run, frame in samples], pin, run.size, **how)


def cameras_of(samples, **how):
    """A camera for each sample (run, frame). All cameras have one scale, at which the largest sheet that is
    not torn fills a panel.

    Each camera looks at the centre of its sheet. If a sheet is torn, the camera shows only the region that an
    unstretched sheet can reach.
    """
    whole = [bool(sample) and sample[0].metrics["mean_strain"][sample[1]] < TORN for sample in samples]
    cameras = [camera_of([sample], reach=1.25 if is_whole else 1.02, **how)
               for sample, is_whole in zip(samples, whole)]
    largest = [camera for camera, is_whole in zip(cameras, whole) if is_whole] or list(filter(None, cameras))
    half = max(((camera.extent[3] - camera.extent[2]) / 2 for camera in largest), default=1)
    return [camera and render.scaled(camera, half) for camera in cameras]


@dataclass
class Panel:
    """One picture in a sheet of pictures."""

    sample: tuple | None  # (run, frame); None: "no run"
    camera: object
    title: str = ""  # above the panel
    text: str = ""  # in a lower corner
    whole: bool = True  # the camera shows the whole cloth
    corner: dict = field(default_factory=lambda: LEFT)  # for the text


def sheet(rows, out, name, inches=2.45, width=360, **bar):
    """Draws rows of panels with one colour bar, and returns the name of the picture. `rows`: label → Panels;
    `inches`: width of a panel; `bar`: arguments for the colour bar."""
    columns = max(map(len, rows.values()))
    shapes = [panel.camera.aspect or 1 for panels in rows.values() for panel in panels if panel.camera]
    height = inches / max(np.median(shapes or [1]), 0.1) + 0.3
    figure, axes = plt.subplots(len(rows), columns, figsize=(inches * columns + 1, height * len(rows)),
                                squeeze=False, layout="compressed")
    for places, (label, panels) in zip(axes, rows.items()):
        for place, panel in zip(places, panels):
            draw_cloth(place, panel, width)
            place.set_title(panel.title)
        places[0].text(-0.03, 0.5, label, transform=places[0].transAxes, rotation=90, ha="right", va="center",
                       fontsize=9.5)
    stretch_bar(figure, axes, **dict(shrink=min(1, 1.6 / len(rows)), pad=0.01, aspect=24) | bar)
    return style.save(figure, out, name)


def draw_cloth(axes, panel, width):
    """Draws the cloth of a panel, its pins and the time. If the panel shall show the whole cloth, the picture
    states the share of vertices outside it."""
    axes.set_axis_off()
    if panel.sample is None:
        axes.text(0.5, 0.5, "no run", ha="center", va="center", color=GREY, transform=axes.transAxes)
        return
    (run, frame), camera = panel.sample, panel.camera
    positions, colours = run.positions(frame), stretch_colours(run.cell("max_stretch", frame) - 1)
    image = render.render(positions, run.triangles, colours, camera, width)
    shape = image.shape[:2]
    axes.imshow(image, interpolation="lanczos", extent=(0, width, shape[0], 0))
    places = camera.project(positions, shape)[0]
    pins = (np.flatnonzero(run.pinned), 5, 0.25), (np.unique(run.pin_seeds), 26, 0.7)
    for vertices, size, edge in pins:
        axes.scatter(*places[vertices].T, s=size, c="#111418", edgecolors="white", linewidths=edge, zorder=3,
                     clip_on=True)
    axes.set_xlim(0, width)
    axes.set_ylim(shape[0], 0)
    corner = free_corner(places, shape)
    time = stamp(axes, run, frame, corner)
    if panel.text:
        caption(axes, panel.text, panel.corner)
    outside = share_outside(positions, camera, shape)
    if panel.whole and outside > 0.005:
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
    """The upper corner of a picture with fewer points in it. `places` (n, 2): the points, in pixels."""
    x, y = places.T / [[shape[1]], [shape[0]]]
    high, left, right = (y > 0) & (y < 0.13), (x > 0) & (x < 0.45), (x > 0.55) & (x < 1)
    return RIGHT if (high & left).sum() > (high & right).sum() else LEFT


def time_text(run, frame):
    """The time of a frame: 't = 4.0 s', or 'at rest, t = 4.0 s' if the cloth is no faster than REST."""
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
    """Share of the vertices that lie outside the picture."""
    xy, nearness = camera.project(positions, shape)
    inside = (nearness > 0) & (xy >= 0).all(axis=1) & (xy[:, 0] <= shape[1]) & (xy[:, 1] <= shape[0])
    return 1 - inside.mean()


def stretch_bar(figure, axes, **how):
    """Draws the colour bar of stretch beside the given axes."""
    bar = figure.colorbar(plt.cm.ScalarMappable(STRETCH_NORM, STRETCH), ax=axes, extend="both", **how)
    bar.set_label("stretch σ₁ − 1")
    ticks = [0.01, 0.03, 0.1, 0.3, 1, 3, 10]
    bar.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    bar.ax.grid(False)
    bar.outline.set_visible(False)
