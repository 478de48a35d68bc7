"""The moving picture of a flight, read off its pixels."""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from PIL import Image

from knotopt.plot.animation import FRAME_TIME, LAST_TIME, PIXELS, animate, views
from knotopt.plot.flight import MARGIN, instants, seen_from_above
from knotopt.viewer.colours import ramp
from tests.helpers.small_flight import crossed, small_plan, small_record

PLAN = small_plan()
RECORD = small_record(PLAN)


def frames(gif: bytes) -> list[np.ndarray]:
    """The frames of a moving picture as arrays of shape (height, width, 3)."""
    with Image.open(io.BytesIO(gif)) as picture:
        shown = []
        for number in range(picture.n_frames):
            picture.seek(number)
            shown.append(np.asarray(picture.convert("RGB"), dtype=int))
        return shown


def pixels(frame: np.ndarray, colour: str) -> np.ndarray:
    """Rows and columns of the pixels of exactly that colour."""
    return np.argwhere((frame == np.round(255 * np.array(to_rgb(colour)))).all(axis=2))


def test_frames_and_their_times() -> None:
    gif = animate(PLAN, RECORD, frames=12)
    assert gif == animate(PLAN, RECORD, frames=12)
    with Image.open(io.BytesIO(gif)) as picture:
        assert picture.size == (PIXELS, PIXELS) and picture.n_frames == 12
        assert picture.info["loop"] == 0  # again and again
        for number in range(12):
            picture.seek(number)
            assert picture.info["duration"] == (LAST_TIME if number == 11 else FRAME_TIME)
    assert all((frame[0, 0] == 255).all() for frame in frames(gif))


def test_robots_fly_as_recorded() -> None:
    leader = ramp(PLAN.robots)[-1]  # no span begins there: its colour is the disc's alone
    shown = frames(animate(PLAN, RECORD, frames=8))
    assert all(len(pixels(frame, leader)) > 100 for frame in shown)
    down_across = np.array([pixels(frame, leader).mean(axis=0) for frame in shown])
    # The view closes in: places in it, as shares of its width, go back to metres.
    low, high = np.moveaxis(views(seen_from_above(RECORD.cable[instants(RECORD, PLAN, 8)])), 2, 0)
    width = (high - low)[:, :1]
    middle = (low + high) / 2 * (1, -1)
    places = middle + width * (down_across[:, ::-1] / PIXELS - 0.5)
    # From the file to the anchor: by x and y as seen at a slant, straight, then it hovers.
    way = np.diff(places, axis=0)
    assert np.linalg.norm(places[-1] - places[0]) > width[0] / 4
    assert np.linalg.norm(way[-1]) < width[0] / PIXELS < np.linalg.norm(way[0])
    turn = np.radians(-15)
    x, y = (RECORD.robots[-1, -1] - RECORD.robots[0, -1])[:2]
    right, away = x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)
    across, down = places[-1] - places[0]
    assert across / down == pytest.approx(right / (-away * np.sin(np.radians(60))), rel=0.02)


def test_all_that_is_still_to_be_seen_is_in_view() -> None:
    seen = seen_from_above(RECORD.cable[instants(RECORD, PLAN, 20)])
    (left, right), (bottom, top) = np.moveaxis(views(seen), 0, 2)
    for frame in range(20):
        later = seen[frame:, :, :2]
        assert (later > (left[frame], bottom[frame])).all()
        assert (later < (right[frame], top[frame])).all()
    # It only ever closes in, on the finished knot, which reaches from side to side or as high.
    assert (np.diff(right - left) <= 1e-9).all()
    room = (right[-1] - left[-1], top[-1] - bottom[-1]) - np.ptp(seen[-1, :, :2], axis=0)
    assert room.min() == pytest.approx(2 * MARGIN)


@pytest.mark.parametrize("lift", [1.0, -1.0])
def test_the_upper_strand_is_whole(lift: float) -> None:
    record = crossed(RECORD, lift)
    frame = frames(animate(PLAN, record, frames=2))[-1]
    first, _, last, _ = ramp(4)
    upper, lower = (last, first) if lift > 0 else (first, last)
    axis = int(lower == first)  # the first strand lies flatter in the picture, the last is steeper
    there = {colour: set(pixels(frame, colour)[:, axis].tolist()) for colour in (upper, lower)}
    missing = sorted(set(range(min(there[lower]), max(there[lower]))) - there[lower])
    assert 3 < len(missing) < 20 and missing == list(range(missing[0], missing[-1] + 1))
    assert there[upper] >= set(missing)


def test_captions_say_what_was_crossed() -> None:
    plain = replace(PLAN, crossings=())
    with_words, without = (frames(animate(plan, RECORD, frames=3)) for plan in (PLAN, plain))
    changed = [np.argwhere((a != b).any(axis=2)) for a, b in zip(with_words, without, strict=True)]
    assert not len(changed[0]) and len(changed[-1])  # nothing is crossed when the leader starts
    assert changed[-1][:, 0].min() > 0.9 * PIXELS


def test_many_robots_and_odd_names() -> None:
    many = replace(RECORD, held=np.arange(RECORD.cable.shape[1]))  # 49 robots
    assert len(frames(animate(replace(PLAN, name="$\\odd_{name"), many, frames=2))) == 2
