"""Documents as Markdown, LaTeX, HTML and CSV: whatever text is in them is shown as it is."""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path

import markdown as python_markdown
import pytest
from hypothesis import given
from hypothesis import strategies as st

from knotopt.document.csv import csv_text
from knotopt.document.formats import WRITERS, Tabulation, writer_for
from knotopt.document.html import html
from knotopt.document.latex import latex, latex_tables
from knotopt.document.markdown import markdown
from knotopt.document.model import Document, Picture, Section, table, tables
from knotopt.errors import OutputError
from tests.helpers.typesetting import typeset

HOSTILE = r"""a_b {c} 50 % #1 \x ~ ^ "q" <script>alert(1)</script> | & $ * ü `m_n`"""
SPECIAL = "|&%_<>\"'\\{}~^#$*[]()!+-.`\n\r\t\u2028\N{MINUS SIGN}\N{EN DASH}\N{KNOT}ü8a "
texts = st.text(st.sampled_from(SPECIAL) | st.characters(codec="utf-8"), max_size=12)
rows = st.lists(st.tuples(texts, texts), min_size=1, max_size=3)


def hostile() -> Document:
    blocks = (
        HOSTILE,
        (HOSTILE,),
        table((HOSTILE, "n"), [(HOSTILE, "1,000")], HOSTILE),
        Picture("drawn", HOSTILE, HOSTILE),
    )
    return Document(HOSTILE, ((HOSTILE, HOSTILE),), (Section(HOSTILE, blocks),))


def shown(text: str) -> str:
    """A text as a reader sees it: code without its marks, one space for spaces and the like."""
    text = re.sub(r"[\x00-\x20\x7f-\x9f\u2028\u2029]+", " ", text)
    return " ".join(re.sub(r"`([^`]+)`", r"\1", text).split())


class Cells(HTMLParser):
    """What stands in the cells of a page's tables; fails where a cell holds more than code."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.cells: list[str] = []
        self.is_inside = False
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: object) -> None:  # noqa: ARG002
        if tag in ("td", "th"):
            self.is_inside = True
            self.cells.append("")
        else:
            assert not self.is_inside or tag == "code", tag

    def handle_endtag(self, tag: str) -> None:
        self.is_inside = self.is_inside and tag not in ("td", "th")

    def handle_data(self, data: str) -> None:
        if self.is_inside:
            self.cells[-1] += data

    @property
    def seen(self) -> list[str]:
        return [" ".join(cell.split()) for cell in self.cells]


@given(rows)
def test_a_page_shows_every_cell_as_it_is(cells: list[tuple[str, str]]) -> None:
    page = html(tables("a", table(("x", "y"), cells, "")), {})
    assert Cells(page).seen == ["x", "y", *(shown(cell) for row in cells for cell in row)]


@given(rows)
def test_markdown_shows_every_cell_as_it_is(cells: list[tuple[str, str]]) -> None:
    text = markdown(tables("", table(("x", "y"), cells, "")))
    assert len(text.splitlines()) == 2 + len(cells)
    page = python_markdown.markdown(text, extensions=["tables"])
    assert Cells(page).seen == ["x", "y", *(shown(cell) for row in cells for cell in row)]


@given(rows)
def test_latex_has_no_command_but_its_own(cells: list[tuple[str, str]]) -> None:
    text = latex_tables(tables("", table(("x", "y"), cells, "")))
    _, *lines = text.partition("\\midrule\n")[2].partition("\\bottomrule")[0].splitlines()
    body = text.partition("\\midrule\n")[2].partition("\\bottomrule")[0]
    assert text.isascii() and len(lines) == len(cells) - 1
    assert body.count(" & ") >= len(cells) and body.count(" \\\\\n") == len(cells)
    assert not re.search(r"(^|\\\\\n)[\[*]", body) and "---" not in body
    names = "backslash|asciigrave|asciitilde|asciicircum|less|greater|bar|tt"
    known = rf"text({names})\b|allowbreak\b|[{{}}&%$#_\\]"
    assert not re.sub(rf"\\({known})", "", body).count("\\")
    bare = re.sub(r"\\[&%$#_{}\\]", "", body)
    assert not set('%#_^~"') & set(bare)
    assert bare.count("&") == len(cells) and bare.count("$") == 2 * bare.count("$-$")
    assert bare.count("{") == bare.count("}")


@given(st.lists(st.tuples(texts, texts), max_size=4))
def test_csv_reads_back(cells: list[tuple[str, str]]) -> None:
    written = csv_text(("a", "b"), [{"a": one, "b": other} for one, other in cells])
    read = list(csv.reader(io.StringIO(written, newline="")))
    assert read == [["a", "b"], *map(list, cells)]


def test_cells_of_csv() -> None:
    rows = [{"a": (1, (2, 3)), "b": None}, {"b": True}]
    assert csv_text(("a", "b"), rows) == 'a,b\n"[1, [2, 3]]",\n,True\n'
    with pytest.raises(ValueError, match="not in fieldnames"):
        csv_text(("a",), [{"c": 1}])


def test_markdown_of_any_text() -> None:
    text = markdown(hostile())
    assert text.startswith("# a_b {c}") and "`m_n`" in text
    assert "<script" not in text and "&lt;script>" in text
    (rule,) = re.findall(r"^\|-.*$", text, re.MULTILINE)
    assert rule == "|---|---:|"
    for line in text.splitlines():
        if line.startswith("|"):
            assert len(re.findall(r"(?<!\\)\|", line)) == 3


def test_underscores_in_markdown() -> None:
    assert markdown(Document("8_19 _a_ b_ __c", (), ())) == "# 8_19 \\_a\\_ b\\_ \\_\\_c\n"


def test_page_of_any_text() -> None:
    text = html(hostile(), {"drawn": b"<svg/>"})
    assert "<script" not in text
    assert "default-src 'none'" in text
    assert not re.findall(r'(?:src|href)="(?!data:|#)', text)
    assert "&lt;script&gt;" in text
    assert "<code>m_n</code>" in text


def test_latex_of_any_text(tmp_path: Path) -> None:
    text = latex(hostile())
    assert text.isascii()
    begun = re.findall(r"\\begin\{(\w+)\}", text)
    assert Counter(begun) == Counter(re.findall(r"\\end\{(\w+)\}", text))
    bare = re.sub(r"\\[{}]", "", text)
    assert bare.count("{") == bare.count("}")
    assert r"a\_b \{c\} 50 \% \#1 \textbackslash{}x" in text
    typeset(
        text.replace(r"\includegraphics", r"\iffalse\includegraphics").replace(
            "drawn.pdf}", r"drawn.pdf}\fi"
        ),
        tmp_path,
    )


def test_tables_are_checked() -> None:
    with pytest.raises(ValueError, match="has 1 cells under 2 heads"):
        table(("a", "b"), [("1",)], "")
    with pytest.raises(ValueError, match="'lc' is not l or r for each of 2 heads"):
        table(("a", "b"), [], "", "lc")
    assert table(("a", "b"), [("x", "–"), ("y", "−0.5")], "").sides == "lr"


def test_the_suffix_names_the_writer() -> None:
    found = Tabulation(tables("A", table(("a",), [("1",)], "Ones.")), ("a",), ({"a": 1},))
    texts = {suffix: writer_for(Path(f"x{suffix}"))(found) for suffix in WRITERS}
    assert texts[".csv"] == "a\n1\n"
    assert texts[".md"] == "# A\n\n| a |\n|---:|\n| 1 |\n\nOnes.\n"
    assert "\\begin{tabular}{r}\n\\toprule\na \\\\\n\\midrule\n1 \\\\\n" in texts[".tex"]
    assert writer_for(Path("X.CSV"))(found) == texts[".csv"]
    with pytest.raises(OutputError, match=r"x.xls: tables are written as .csv, .md, .tex"):
        writer_for(Path("x.xls"))
