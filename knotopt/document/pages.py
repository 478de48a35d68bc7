"""What pages of HTML are put together from: files of a package, and a policy that names them.

`page.css` is the style that all pages share.
"""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Mapping
from importlib import resources


def part(package: str, name: str) -> str:
    """The text of a file that ships in a package."""
    return resources.files(package).joinpath(name).read_text(encoding="utf-8").strip()


def style(package: str, name: str) -> str:
    """The style that all pages share, and after it that of a package's page."""
    return part(__package__, "page.css") + "\n" + part(package, name)


def filled(template: str, parts: Mapping[str, str]) -> str:
    """A template with the parts in place of their names in double braces."""
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], template)


def digest(text: str) -> str:
    """A source of a content security policy: this very text and no other."""
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii")
