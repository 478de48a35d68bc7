"""The documentation as a site: built without a warning, and read without a network."""

from __future__ import annotations

import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import knotopt

if TYPE_CHECKING:
    from playwright.sync_api import Browser

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the site; every warning is an error."""
    folder: Path = tmp_path_factory.mktemp("site")
    done = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def html(site: Path) -> list[Path]:
    return [page for page in site.rglob("*.html") if page.name != "404.html"]


def test_every_page_and_every_public_name_is_there(site: Path) -> None:
    built = {page.relative_to(site).with_suffix("").as_posix() for page in html(site)}
    written = (page.relative_to(ROOT / "docs") for page in (ROOT / "docs").rglob("*.md"))
    assert built >= {*(page.with_suffix("").as_posix() for page in written), "reference/public"}
    text = (site / "reference/public.html").read_text("utf-8")
    headings = re.findall(r"<h3.*?</h3>", text, re.DOTALL)
    shown = {word for heading in headings for word in re.findall(r"knotopt\.(\w+)\s*<", heading)}
    assert shown == set(knotopt.__all__)


class Loaded(HTMLParser):
    """What a page loads: everything it names but what its links lead to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.targets: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for key, value in attrs:
            if key in ("src", "data", "poster") or (key == "href" and tag != "a"):
                self.targets.append(value or "")


def test_what_pages_and_style_sheets_load_lies_in_the_site(site: Path) -> None:
    for page in html(site):
        for target in Loaded(page.read_text("utf-8")).targets:
            there = target.startswith("data:") or (page.parent / target.split("?")[0]).exists()
            assert there, f"{page.name} loads {target}"
    for sheet in site.rglob("*.css"):
        assert not re.search(r"(url\(|@import)\s*[\"']?(https?:)?//", sheet.read_text("utf-8")), (
            sheet
        )


def test_it_is_searched_offline(site: Path, browser: Browser) -> None:
    """No page logs an error, or loads anything from elsewhere."""
    complaints: list[str] = []
    asked: list[str] = []
    page = browser.new_context(offline=True).new_page()
    page.on("console", lambda message: complaints.append(message.text))
    page.on("request", lambda request: asked.append(request.url))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    for each in html(site):
        page.goto(each.as_uri())
    page.goto((site / "index.html").as_uri())
    page.click("input[name=query]")
    page.wait_for_function("typeof __index === 'object'")
    page.keyboard.type("minimal supports", delay=50)
    page.wait_for_selector(".md-search-result__link", state="attached", timeout=60_000)
    found = page.eval_on_selector_all(
        ".md-search-result__link", "links => links.map(link => link.href)"
    )
    assert any("reference/public.html#knotopt.supports.minimal" in link for link in found)
    assert not complaints
    assert not [url for url in asked if not url.startswith(("file:", "data:", "blob:"))]
