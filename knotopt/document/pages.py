"""What every page of HTML is put together from: a shell, a style, a policy, files of a package."""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Mapping
from html import escape
from importlib import resources


def page(title: str, body: str, style: str, script: str = "") -> str:
    """A page that loads nothing, and runs nothing but its own script.

    Parameters
    ----------
    title : str
        Shown as it is.
    body, style, script : str
        HTML, with the script if there is one; CSS after that of all pages; JavaScript.
    """
    css = part(__package__, "page.css") + "\n" + style
    runs = f"script-src '{_digest(script)}'; " if script else ""
    parts = {
        "policy": f"default-src 'none'; img-src data:; {runs}style-src '{_digest(css)}'",
        "title": escape(title),
        "style": css,
        "body": body,
    }
    return filled(part(__package__, "page.html"), parts)


def part(package: str, name: str) -> str:
    """The text of a file that ships in a package."""
    return resources.files(package).joinpath(name).read_text(encoding="utf-8").strip()


def filled(template: str, parts: Mapping[str, str]) -> str:
    """A template with the parts in place of their names in double braces."""
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], template)


def _digest(text: str) -> str:
    """A source of a content security policy: this very text and no other."""
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii")
