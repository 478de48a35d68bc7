"""The pieces that pages are put together from, and how a policy names them."""

from __future__ import annotations

import base64
import hashlib
from importlib import resources


def part(name: str) -> str:
    """The text of a file that ships beside this one."""
    return resources.files("knotopt.viewer").joinpath(name).read_text(encoding="utf-8").strip()


def digest(text: str) -> str:
    """A source of a content security policy: this very text and no other."""
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii")
