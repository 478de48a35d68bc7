"""The browser of the tests: a Chromium that is installed has to start; without one they skip."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from shutil import which
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Playwright

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


def installed(playwright: Playwright) -> str | None:
    """The path of a Chromium: the system's, or the one that Playwright has downloaded."""
    for path in map(which, NAMES):
        if path is not None:
            return path
    own = playwright.chromium.executable_path
    return own if Path(own).exists() else None


@contextmanager
def started() -> Iterator[Browser]:
    """A browser.

    While it is open, an event loop runs in this thread.
    """
    from playwright.sync_api import Error, sync_playwright

    with sync_playwright() as playwright:
        path = installed(playwright)
        if path is None:
            pytest.skip("no Chromium is installed")
        try:
            browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        except Error as error:
            pytest.fail(f"the Chromium at {path} does not start: {error.message}", pytrace=False)
        yield browser
        browser.close()
