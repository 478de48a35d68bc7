"""Property tests draw the same examples every time, so that a failure on one machine is one on all.

`pytest --hypothesis-profile=explore` draws new ones.
"""

from __future__ import annotations

import pytest
from hypothesis import settings

from tests.helpers.command_line import Cli

settings.register_profile("fixed", derandomize=True, deadline=None)
settings.register_profile("explore", deadline=None, max_examples=1000, print_blob=True)
settings.load_profile("fixed")


@pytest.fixture
def cli(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Cli:
    return Cli(capsys, monkeypatch)
