"""Property tests draw the same examples every time, so that a failure on one machine is one on all.

`pytest --hypothesis-profile=explore` draws new ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest
from hypothesis import settings

from tests.helpers import chromium
from tests.helpers.command_line import Cli

if TYPE_CHECKING:
    from playwright.sync_api import Browser

settings.register_profile("fixed", derandomize=True, deadline=None)
settings.register_profile("explore", deadline=None, max_examples=1000, print_blob=True)
settings.load_profile("fixed")


@pytest.fixture
def cli(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Cli:
    return Cli(capsys, monkeypatch)


@pytest.fixture(scope="module")  # not the session: other modules have event loops of their own
def browser() -> Iterator[Browser]:
    with chromium.started() as opened:
        yield opened
