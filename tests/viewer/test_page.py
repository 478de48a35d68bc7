"""The page of a flight, as text and in a real browser, opened from a file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from knotopt.errors import RequirementError
from knotopt.flight.plan import FlightPlan
from knotopt.viewer.colours import ramp
from knotopt.viewer.packing import resampled
from knotopt.viewer.page import flight_page
from tests.helpers.small_flight import small_plan, small_record

PLAN = small_plan()
RECORD = small_record(PLAN)
HOSTILE = """</script><script>window.hit = 1</script><img src=x onerror="window.hit = 2">'"&"""
CSV = 't,robot,x\r\n0,1,0.5\n\u00e9\u2028</script>,"quoted"\n' + "0.25,2,1.75\n" * 2000


@dataclass
class Opened:
    """A page, what it asked for, and what it complained of."""

    page: Any
    requests: list[str] = field(default_factory=list)
    complaints: list[str] = field(default_factory=list)

    def robots(self) -> np.ndarray:
        return np.array(self.page.evaluate("window.flight.robots()"))

    def seek(self, time: float) -> None:
        """Move the slider, as a hand on it would."""
        self.page.locator("#time").evaluate(
            "(slider, time) => { slider.value = time; slider.dispatchEvent(new Event('input')); }",
            time,
        )

    def wait(self, script: str) -> None:
        """Until it is true; the page's own policy forbids Playwright's way of waiting."""
        for _ in range(200):
            if self.page.evaluate(script):
                return
            self.page.wait_for_timeout(50)
        pytest.fail(f"never: {script}")

    def number(self, script: str) -> float:
        return float(self.page.evaluate(script))


@pytest.fixture
def open_page(browser: Any, tmp_path: Path) -> Iterator[Any]:
    contexts = []

    def opened(content: str, **settings: Any) -> Opened:
        path = tmp_path / "viewer.html"
        path.write_bytes(content.encode())
        context = browser.new_context(**settings)
        contexts.append(context)
        opened = Opened(context.new_page())
        opened.page.on("request", lambda request: opened.requests.append(request.url))
        opened.page.on("console", lambda message: opened.complaints.append(message.text))
        opened.page.on("pageerror", lambda error: opened.complaints.append(str(error)))
        opened.page.goto(path.as_uri())
        opened.page.wait_for_selector("html[data-ready]")
        return opened

    yield opened
    for context in contexts:
        context.close()


def quiet(opened: Opened) -> bool:
    return not opened.complaints and all(url.startswith("file://") for url in opened.requests)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_opens_from_a_file_and_asks_for_nothing(open_page: Any, scheme: str) -> None:
    opened = open_page(
        flight_page(
            PLAN,
            [("simulation", RECORD)],
            [("time of flight", "11 s")],
            [{"planned": "span 4 over span 1", "executed": "missed"}],
            {"a.csv": CSV},
        ),
        color_scheme=scheme,
    )
    page = opened.page
    assert page.title() == "Flight of 3_1"
    assert page.locator("#trouble").is_hidden()
    for name in ("Measures", "Planned crossings", "Crossings as executed", "Downloads"):
        assert page.get_by_role("heading", name=name, exact=True).is_visible()
    assert "missed" in page.locator("section[aria-labelledby=events]").inner_text()
    for name in ("scene", "above", "heights"):
        colours = page.locator(f"#{name}").evaluate(
            "(canvas) => new Set(new Uint32Array(canvas.getContext('2d').getImageData("
            "0, 0, canvas.width, canvas.height).data.buffer)).size"
        )
        assert colours > 20, f"{name} shows something"
    assert quiet(opened), (opened.complaints, opened.requests)


def test_the_slider_moves_the_robots_of_a_plan(open_page: Any) -> None:
    opened = open_page(flight_page(PLAN))
    assert opened.robots() == pytest.approx(PLAN.positions[0], abs=0.002)
    for time in (5.0, 11.0):
        opened.seek(time)
        frame = round(time / PLAN.interval)
        assert opened.robots() == pytest.approx(PLAN.positions[frame], abs=0.002)
    opened.page.locator("#time").press("Home")
    assert opened.number("window.flight.time()") == 0
    assert opened.robots() == pytest.approx(PLAN.positions[0], abs=0.002)
    assert opened.page.locator("#shown").is_hidden(), "nothing to choose from"


def test_the_planned_cable_hangs_with_its_length(open_page: Any) -> None:
    opened = open_page(flight_page(PLAN))
    for time in (0.0, 5.0, 11.0):
        opened.seek(time)
        robots = opened.robots()
        spans = [np.array(span) for span in opened.page.evaluate("window.flight.cable()")]
        for j, span in enumerate(spans):
            assert span[[0, -1]] == pytest.approx(robots[j : j + 2])
            length = np.linalg.norm(np.diff(span, axis=0), axis=1).sum()
            assert length == pytest.approx(PLAN.lengths[j], rel=0.01)
            assert span[:, 2].min() >= 0


def test_a_record_is_shown_first_and_the_plan_can_be_chosen(open_page: Any) -> None:
    opened = open_page(flight_page(PLAN, [("seed 0", RECORD)]))
    assert opened.number("window.flight.duration()") == pytest.approx(12.1)
    opened.seek(6.05)
    frame = len(RECORD.times) // 2
    assert opened.robots() == pytest.approx(RECORD.robots[frame], abs=0.01)
    cable = opened.page.evaluate("window.flight.cable()")
    assert np.array(cable[0]) == pytest.approx(RECORD.cable[frame, : RECORD.held[1] + 1], abs=0.01)
    opened.page.get_by_role("button", name="Go to 5.0 seconds").click()
    assert opened.number("window.flight.time()") == pytest.approx(5.5, abs=0.25), "robots are late"
    assert "span 4 over span 1" in opened.page.locator("#status").inner_text()
    opened.page.locator("#shown").select_option(label="Plan")
    assert opened.number("window.flight.duration()") == 11
    assert quiet(opened)


def test_play_goes_on_to_the_end_and_space_pauses(open_page: Any) -> None:
    opened = open_page(flight_page(PLAN))
    page = opened.page
    page.locator("#speed").select_option("0.5")
    page.get_by_role("button", name="Play", exact=True).click()
    opened.wait("window.flight.time() > 0.1")
    page.locator("#scene").press(" ")
    assert page.get_by_role("button", name="Play", exact=True).is_visible()
    stopped = opened.number("window.flight.time()")
    page.wait_for_timeout(100)
    assert opened.number("window.flight.time()") == stopped
    opened.seek(10.5)
    page.locator("#speed").select_option("8")
    page.locator("#time").press(" ")
    opened.wait("window.flight.time() === 11")
    page.wait_for_selector("#play[aria-label=Play]")
    assert quiet(opened)


def test_mouse_and_keys_turn_the_scene(open_page: Any) -> None:
    opened = open_page(flight_page(PLAN))
    page = opened.page
    before = page.evaluate("window.flight.camera()")
    box = page.locator("#scene").bounding_box()
    page.mouse.move(box["x"] + 100, box["y"] + 100)
    page.mouse.down()
    page.mouse.move(box["x"] + 180, box["y"] + 110)
    page.mouse.up()
    after = page.evaluate("window.flight.camera()")
    assert after["yaw"] < before["yaw"] and after["pitch"] > before["pitch"]
    page.locator("#scene").press("ArrowRight")
    page.locator("#scene").press("+")
    turned = page.evaluate("window.flight.camera()")
    assert turned["yaw"] < after["yaw"] and turned["zoom"] < after["zoom"]
    page.get_by_role("button", name="Top").click()
    assert page.evaluate("window.flight.camera()")["pitch"] == pytest.approx(np.pi / 2)


def test_downloads_are_the_exact_texts(open_page: Any) -> None:
    opened = open_page(
        flight_page(PLAN, downloads={"way points.csv": CSV, "empty.json": ""}),
        accept_downloads=True,
    )
    for name, text in (("way points.csv", CSV), ("empty.json", "")):
        with opened.page.expect_download() as started:
            opened.page.get_by_role("link", name=name).click()
        assert started.value.suggested_filename == name
        assert Path(started.value.path()).read_bytes() == text.encode()
    assert not opened.complaints


def test_hostile_texts_are_shown_as_they_are(open_page: Any) -> None:
    plan = replace(PLAN, name=HOSTILE, chosen_by=HOSTILE, notes=(HOSTILE, "{{data}}"))
    opened = open_page(
        flight_page(
            plan,
            [(HOSTILE, RECORD)],
            [(HOSTILE, HOSTILE)],
            [{HOSTILE: HOSTILE}, {"other": HOSTILE}],
            {HOSTILE: HOSTILE},
        )
    )
    page = opened.page
    assert page.evaluate("window.hit") is None
    assert page.title() == f"Flight of {HOSTILE}"
    assert page.locator("h1").text_content() == f"Flight of {HOSTILE}"
    assert page.locator("ul.notes li").all_text_contents() == [HOSTILE, "{{data}}"]
    assert page.locator("#files a").text_content() == HOSTILE
    assert page.locator("img").count() == 0
    assert quiet(opened)


@pytest.mark.parametrize("width", [320, 390])
def test_a_phone_shows_it_without_scrolling_sideways(open_page: Any, width: int) -> None:
    plan = replace(PLAN, name="a_knot_with_a_name_of_some_length" * 3)
    opened = open_page(
        flight_page(
            plan,
            [("simulation with a name that is long, seed 0", RECORD)],
            [("a measure with a long name", "a value " * 20)],
            [{f"column {k}": "something of length" for k in range(8)}],
            {"n" * 90 + ".csv": CSV},
        ),
        viewport={"width": width, "height": 700},
        device_scale_factor=2,
        has_touch=True,
        is_mobile=True,
    )
    assert opened.number("document.documentElement.scrollWidth") <= width
    assert quiet(opened)


def wide_plan(robots: int, seconds: float) -> FlightPlan:
    rng = np.random.default_rng(0)
    times = np.arange(0, seconds, 0.05)
    phase = rng.uniform(0, 6, (robots, 3))
    positions = 2 + np.sin(0.2 * times[:, None, None] + phase)
    return replace(
        PLAN,
        supports=tuple(range(2, robots)),
        times=times,
        positions=positions,
        lengths=np.full(robots - 1, 4.5),
        route=positions[:, -1],
    )


def test_a_long_flight_of_many_robots_stays_small() -> None:
    plan = wide_plan(22, 120)
    record = small_record(plan, 130)
    csv = "\n".join(
        f"{time:.2f},{robot},{x:.4f},{y:.4f},{z:.4f},0"
        for time, places in zip(plan.times[::2], plan.positions[::2], strict=True)
        for robot, (x, y, z) in enumerate(places, 1)
    )
    assert len(flight_page(plan, [("a", record), ("b", record)], downloads={"w.csv": csv})) < 2e6


def test_nothing_but_the_page_itself_is_allowed() -> None:
    page = flight_page(PLAN)
    assert not re.search(r"(src|href)=\"(?!data:,)", page)
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', page)
    assert policy and policy[1].startswith("default-src 'none';") and "unsafe" not in policy[1]


def test_positions_that_are_no_numbers_are_refused() -> None:
    broken = RECORD.cable.copy()
    broken[3, 4, 1] = np.nan
    with pytest.raises(RequirementError, match="the record seed 3 has positions that are not"):
        flight_page(PLAN, [("seed 3", replace(RECORD, cable=broken))])


def test_a_flight_without_crossings_or_supports() -> None:
    plan = replace(PLAN, supports=(), positions=PLAN.positions[:, [0, -1]], lengths=np.array([3.0]))
    page = flight_page(replace(plan, crossings=()))
    assert "crosses no cable" in page and "<dd>none</dd>" in page


def test_resampling_keeps_ends_and_lines() -> None:
    times = np.array([0.0, 0.5, 1.0, 1.5])
    values = np.column_stack((times, 2 * times))
    found = resampled(times, values, 7)
    assert found[:, 0] == pytest.approx(np.linspace(0, 1.5, 7))
    assert found[:, 1] == pytest.approx(np.linspace(0, 3, 7))
    assert resampled(times[:1], values[:1], 2) == pytest.approx(values[[0, 0]])


def test_colours_are_distinct() -> None:
    for count in (2, 7, 22):
        assert len(set(ramp(count))) == count
