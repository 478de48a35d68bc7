"""Grid diagrams written as people and programs write them, at random."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence

from hypothesis import strategies as st

from knotopt.diagram.grid import GridDiagram

Draw = st.DrawFn
Rows = Sequence[Sequence[object]]


@st.composite
def tables(draw: Draw, rows: Rows, header: Sequence[str] = (), *, is_square: bool = False) -> str:
    """Rows as a table: separator, spaces, minus sign, whole floats, remarks, line ends."""
    separator = draw(st.sampled_from([",", ";", "\t", " ", "  ", ", ", " | "]))
    minus = draw(st.sampled_from(["-", "\u2212", "\u2013"]))
    floats = draw(st.booleans())
    comma = separator == ";" and draw(st.booleans())

    def cell(entry: object) -> str:
        text = f"{entry}.0" if floats and isinstance(entry, int) else str(entry)
        return (text.replace(".", ",") if comma else text).replace("-", minus)

    lines = [separator.join(map(cell, row)) for row in rows]
    if header:
        lines.insert(0, separator.join(header))
    elif is_square and separator != " | " and separator.strip() and draw(st.booleans()):
        lines = [f"{number}{separator}{line}" for number, line in enumerate(lines)]
        lines.insert(0, separator + separator.join(map(str, range(len(rows)))))
    if separator.strip() and draw(st.booleans()):
        lines = [line + separator for line in lines]
    if draw(st.booleans()):
        lines.insert(0, draw(st.sampled_from(["# a grid", "% a grid", "// a grid"])))
    if draw(st.booleans()):
        lines.insert(draw(st.integers(0, len(lines))), "")
    return draw(st.sampled_from(["\n", "\r\n"])).join(lines) + draw(st.sampled_from(["", "\n"]))


@st.composite
def lists(draw: Draw, rows: Rows) -> str:
    """Rows as nested lists of JSON, Python, numpy, Mathematica or Sage."""
    python = str([list(row) for row in rows])
    tuples = str(tuple(map(tuple, rows)))
    lines = [" ".join(f"{entry:2}" for entry in row) for row in rows]
    return draw(
        st.sampled_from(
            [
                json.dumps([list(row) for row in rows]),
                python,
                python.replace(" ", ""),
                tuples,
                python.replace("[", "{").replace("]", "}"),
                python.replace("[", "{").replace("]", "}").replace(",", ";"),
                f"array({python})",
                f"array({python}, dtype=int8)",
                f"Matrix({python})",
                "[[" + "]\n [".join(lines) + "]]",
                "\n".join(f"[{line}]" for line in lines),
                json.dumps(python),
                python.replace("-", "\u2212").replace(" ", "\u00a0"),
            ]
        )
    )


def written(
    rows: Rows, header: Sequence[str] = (), *, is_square: bool = False
) -> st.SearchStrategy[str]:
    return lists(rows) | tables(rows, header, is_square=is_square)


@st.composite
def matrix(draw: Draw, diagram: GridDiagram) -> str:
    rows = diagram.matrix.tolist()
    keyed = json.dumps({"comment": "any", "matrix": rows})
    return draw(written(rows, is_square=True) | st.just(keyed))


@st.composite
def marks(draw: Draw, diagram: GridDiagram) -> str:
    base = draw(st.integers(0, 1))
    listed = draw(st.permutations([(c - 1 + base, r - 1 + base) for c, r in diagram.marks]))
    header: tuple[str, ...] = draw(
        st.sampled_from([(), ("x", "y"), ("column", "row"), ("Col", "Row"), ("row", "column")])
    )
    keyed = json.dumps({"knot": "any", "grid": [list(mark) for mark in listed]})
    if header[:1] == ("row",):
        return draw(tables([mark[::-1] for mark in listed], header))
    return draw((tables(listed, header) if header else written(listed)) | st.just(keyed))


def pairs_of(diagram: GridDiagram) -> list[list[int]]:
    pairs: list[list[int]] = [[] for _ in range(diagram.size)]
    for column, row in diagram.marks:
        pairs[row - 1].append(column)
    return pairs


@st.composite
def arc(draw: Draw, diagram: GridDiagram) -> str:
    pairs = [draw(st.permutations(pair)) for pair in pairs_of(diagram)]
    inner = ", ".join("{" + ", ".join(map(str, pair)) + "}" for pair in pairs)
    in_a_row = " ".join(str(column) for pair in pairs for column in pair)
    forms = [f"ArcPresentation[{inner}]", json.dumps({"arc_notation": "{" + inner + "}"})]
    if diagram.size >= 5:
        forms.append(in_a_row)
    return draw(written(pairs) | st.sampled_from(forms))


@st.composite
def xo(draw: Draw, diagram: GridDiagram) -> str:
    base = draw(st.integers(0, 1))
    xs = [row - 1 + base for row in diagram.minus]
    os = [row - 1 + base for row in diagram.plus]
    x, o = draw(st.sampled_from([("X", "O"), ("x", "o"), ("Xlist", "Olist")]))
    places = range(1, diagram.size + 1)
    by_row = [[rows.index(k) + base for k in places] for rows in (diagram.minus, diagram.plus)]
    blank = draw(st.sampled_from([".", "", " ", "0"]))
    letters = {0: blank, -1: x[0], 1: o[0]}
    table = [[letters[entry] for entry in line] for line in diagram.matrix.tolist()]
    solid = "\n".join("".join(cell or "." for cell in line).replace(" ", ".") for line in table)
    crossings = 3 * diagram.crossing_cells.T[::-1].astype(int)
    numbers = (crossings + (diagram.matrix < 0) + 2 * (diagram.matrix > 0)).tolist()
    forms = [
        json.dumps({x: xs, o: os}),
        str({o: tuple(os), x: tuple(xs)}),
        f"X = {xs}\nO = {os}\ngridlist = [\n  [0,1]]\nmoves = []\n",
        f"{x}={xs};   {o}={os}",
        repr(diagram),
        str(by_row),
        solid,
        json.dumps(table),
        json.dumps(solid.split()),
        ",\n".join(",".join(line) for line in table),
        "\n".join("|".join(line) for line in table),
        json.dumps(numbers),
        str(numbers).replace("],", "]\n"),
    ]
    return draw(st.sampled_from(forms))


FORMS: dict[str, Callable[[GridDiagram], st.SearchStrategy[str]]] = {
    "matrix": matrix,
    "marks": marks,
    "arc": arc,
    "xo": xo,
}
"""Name of a form, as `--as` has it, to what writes a diagram in it."""


@st.composite
def encoded(draw: Draw, text: str) -> bytes:
    """Text as files have it."""
    encoding = draw(st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"]))
    return text.encode(encoding)
