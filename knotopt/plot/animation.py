"""A flight as a moving picture: a GIF of the cable and its robots, from above at a slant."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from PIL import Image

from knotopt.arrays import FloatArray
from knotopt.flight.plan import FlightPlan
from knotopt.flight.record import FlightRecord
from knotopt.plot.flight import MARGIN, caption, draw_strands, instants, seen_from_above
from knotopt.viewer.colours import ramp

FRAMES = 80
PIXELS = 480  # width and height
FRAME_TIME, LAST_TIME = 90, 2500  # that a frame, and the last one, stays [ms]
_DPI = 100
_DISC, _LEADER = 12.0, 15.0  # diameter of a robot [points]
_GREY = "#555555"
_SHARE = 0.86  # of the height, between two lines of text


def animate(plan: FlightPlan, record: FlightRecord, title: str = "", frames: int = FRAMES) -> bytes:
    """The flight as a GIF that plays again and again; the same bytes every time.

    A robot has the colour of the span that begins there; of two strands the upper one is whole.

    Parameters
    ----------
    plan : FlightPlan
        That was flown; gives the crossings due.
    record : FlightRecord
    title : str
        Above every frame; by default the knot and the robots.
    frames : int
        Number of instants, evenly spaced from when the leader starts to the end.
    """
    chosen = instants(record, plan, frames)
    seen = seen_from_above(record.cable[chosen])
    figure = Figure(figsize=(PIXELS / _DPI, PIXELS / _DPI))
    axes = figure.add_axes((0, (1 - _SHARE) / 2, 1, _SHARE))
    axes.set_axis_off()
    figure.text(0.03, 0.94, title or f"{plan.name}: {plan.robots} robots", parse_math=False)
    words = figure.text(0.03, 0.03, "", color=_GREY)
    palette = _palette(len(record.held))
    pictures = []
    for frame, strands, (across, up) in zip(chosen, seen, views(seen), strict=True):
        for artist in (*axes.collections, *axes.lines, *axes.texts):
            artist.remove()
        axes.set(xlim=across, ylim=up)
        draw_strands(axes, strands, record)
        _draw_robots(axes, strands[record.held])
        words.set_text(caption(record, plan, frame))
        drawn = io.BytesIO()
        figure.savefig(drawn, format="rgba", dpi=_DPI)
        picture = Image.frombytes("RGBA", (PIXELS, PIXELS), drawn.getvalue()).convert("RGB")
        pictures.append(picture.quantize(palette=palette, dither=Image.Dither.NONE))
    buffer = io.BytesIO()
    first, *others = pictures
    times = [FRAME_TIME] * len(others) + [LAST_TIME]
    first.save(buffer, "GIF", save_all=True, append_images=others, duration=times, loop=0)
    return buffer.getvalue()


def views(seen: FloatArray) -> FloatArray:
    """Limits (left, right), (bottom, top) of each frame, shape (frames, 2, 2).

    A frame shows the place of all that is still to be seen: the view closes in as robots that
    waited outside take their turns, and the finished knot fills it.
    """
    backwards = seen[::-1, :, :2]
    low = np.minimum.accumulate(backwards.min(axis=1))[::-1] - MARGIN
    high = np.maximum.accumulate(backwards.max(axis=1))[::-1] + MARGIN
    half = ((high - low) / (1, _SHARE)).max(axis=1, keepdims=True) / 2 * (1, _SHARE)
    middle = (low + high) / 2
    return np.stack((middle - half, middle + half), axis=2)


def _draw_robots(axes: Axes, seen: FloatArray) -> None:
    """Robots as numbered discs, from far to near."""
    colours = ramp(len(seen))
    for index in np.argsort(seen[:, 2]).tolist():
        x, y = seen[index, :2].tolist()
        size = _LEADER if index == len(seen) - 1 else _DISC
        disc = {"color": colours[index], "markersize": size, "markeredgecolor": "black"}
        axes.plot(x, y, "o", zorder=3, **disc)
        axes.text(x, y, str(index + 1), **_NUMBER)


def _palette(robots: int) -> Image.Image:
    """The colours of all frames, each in steps to white, and black on a robot's colour.

    With a palette of their own, made for their mixture, frames would flicker.
    """
    inks = np.array([to_rgb(colour) for colour in (*ramp(robots), _GREY, "black")])
    steps = max(2, min(6, 255 // len(inks)))
    shades = 1 - np.linspace(0, 1, steps + 1)[1:, None, None] * (1 - inks)
    colours = np.vstack((np.ones(3), shades.reshape(-1, 3)))[:256]
    palette = Image.new("P", (1, 1))
    palette.putpalette(np.round(255 * colours).astype(np.uint8).tobytes())
    return palette


_NUMBER: dict[str, Any] = {
    "ha": "center",
    "va": "center_baseline",
    "fontsize": 8,
    "color": "white",
    "zorder": 3,
    "clip_on": True,
}
