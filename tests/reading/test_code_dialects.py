"""Each form of a code written in a random dialect is read back as the same diagram, and a code with
mistakes in it is read as a knot or refused with one sentence.
"""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from knotopt.errors import KnotoptError
from knotopt.planar.braid import from_braid
from knotopt.planar.braid_of_grid import braid_of_grid
from knotopt.planar.dt import MOST_LETTERS, dt_code, dt_flips, dt_letters, from_dt
from knotopt.planar.from_grid import planar_diagram
from knotopt.planar.gauss import from_gauss, gauss_code, gauss_letters, oriented_gauss_code
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.reading.knot import read_knot
from tests.helpers.knotinfo_codes import knotinfo_codes
from tests.helpers.random_diagrams import random_diagrams
from tests.helpers.strategies import diagrams, planar_diagrams
from tests.helpers.understood import understood

BRACKETS = ("[]", "()", "{}")
SEPARATORS = (",", ", ", ";", "; ", " ", " , ", ",\n ", "\t")
MINUS = ("-", "\u2212", "\u2013")
KNOTTED = planar_diagrams().filter(lambda diagram: len(diagram.crossings) > 2)


@st.composite
def layouts(draw: st.DrawFn) -> Callable[[object], str]:
    """A way to write nested lists of whole numbers."""
    brackets = draw(st.tuples(st.sampled_from(BRACKETS), st.sampled_from(BRACKETS)))
    separator, minus = draw(st.sampled_from(SEPARATORS)), draw(st.sampled_from(MINUS))
    whole = draw(st.sampled_from(("", ".0", ".")))
    blank = draw(st.sampled_from(("", " ", "\n")))

    def write(value: object, depth: int = 0) -> str:
        if not isinstance(value, list | tuple):
            return f"{value}{whole}".replace("-", minus)
        opening, closing = brackets[depth % 2]
        inside = separator.join(write(entry, depth + 1) for entry in value)
        return f"{opening}{blank}{inside}{blank}{closing}"

    return write


@given(KNOTTED, layouts(), st.data())
def test_pd(diagram: PlanarDiagram, write: Callable[[object], str], data: st.DataObject) -> None:
    first = data.draw(st.sampled_from((0, 1, 17)))
    crossings = [tuple(edge + first for edge in crossing) for crossing in diagram.crossings]
    listed = write(crossings)
    written = [
        listed,
        f"PD: {listed}",
        f'{{"pd_code": {[list(crossing) for crossing in crossings]}}}',
        f"PD[{', '.join(f'X{list(crossing)}' for crossing in crossings)}]",
        "\n".join(" ".join(map(str, crossing)) for crossing in crossings),
        "\n".join(",".join(map(str, crossing)) for crossing in crossings) + "\n",
        " ".join("X" + ",".join(map(str, crossing)) for crossing in crossings),
    ]
    assert understood(data.draw(st.sampled_from(written)))[:2] == ("PD code", diagram)


@given(KNOTTED, layouts(), st.data())
def test_dt(diagram: PlanarDiagram, write: Callable[[object], str], data: st.DataObject) -> None:
    code, flips = dt_code(diagram), dt_flips(diagram)
    exact = data.draw(st.booleans())
    written = [f"DT: [{code}]", f"DT:[{code}]".replace(" ", "")]
    if len(code) <= MOST_LETTERS:
        written += [f"DT: {dt_letters(code)}", f"DT[{dt_letters(code)}]"]
    if exact:
        bits = "".join(map(str, flips))
        written = [
            f"{text[:-1]}.{bits}]" if text[2] == "[" else f"{text}.{bits}" for text in written[2:]
        ] + [f"{text}, {list(flips)}" for text in written[:2]]
    else:
        written += [write(code), write([code]), f"DTCode{list(code)}", f"DT: {write(code)}"]
        if len(code) <= MOST_LETTERS:
            written += [dt_letters(code), dt_letters(code)[3:]]
    title, found, notes = understood(data.draw(st.sampled_from(written)))
    assert (title, found) == ("DT code", from_dt(code, flips if exact else None))
    assert dt_code(found) == code
    assert not (exact and notes)


@given(KNOTTED, layouts(), st.data())
def test_gauss(diagram: PlanarDiagram, write: Callable[[object], str], data: st.DataObject) -> None:
    code, signs = oriented_gauss_code(diagram)
    exact = data.draw(st.booleans())
    letters = gauss_letters(diagram)
    if exact:
        written = [
            write([[code], signs]),
            write([code, signs]),
            letters,
            letters.replace("+", "+ ").replace("-", "- "),
            letters.replace("+", "+,").replace("-", "\u2212,").rstrip(","),
            letters.lower(),
        ]
    else:
        written = [
            write(code),
            write([code]),
            " ".join(map(str, code)),
            f"GaussCode{list(code)}",
            f"Gauss code: {write(code)}",
            letters.replace("+", "").replace("-", " "),
            ", ".join(f"{abs(entry)}{'+' if entry > 0 else '-'}" for entry in code),
        ]
    title, found, _ = understood(data.draw(st.sampled_from(written)))
    assert (title, found) == ("Gauss code", from_gauss(code, signs if exact else None))
    assert gauss_code(found) == code


@given(diagrams(max_size=12), layouts(), st.data())
def test_braid(grid: object, write: Callable[[object], str], data: st.DataObject) -> None:
    word, strands = braid_of_grid(grid)  # type: ignore[arg-type]
    if len(word) < 3:
        return
    written = [
        f"Braid[{strands}, {{{', '.join(map(str, word))}}}]",
        f"BR[{strands},{{{','.join(map(str, word))}}}]",
        f"Braid{list(word)}",
        f"braid: {write(word)}",
        write([strands, word]),
        write([word, strands]),
        "*".join(f"s{abs(i) - 1}{'^-1' if i < 0 else ''}" for i in word),
        " ".join(f"sigma_{abs(i)}{'^{-1}' if i < 0 else ''}" for i in word),
        "".join(f"σ{abs(i)}{'⁻¹' if i < 0 else ''}" for i in word),
        "Braid: " + "".join(chr(abs(i) + (64 if i < 0 else 96)) for i in word),
    ]
    text = data.draw(st.sampled_from(written))
    assert understood(text)[:2] == ("braid word", from_braid(word, strands))


def examples(form: str) -> list[str]:
    """Codes as their sources write them: KnotInfo's up to 8 crossings, and larger ones of ours."""
    cells = [getattr(codes, form) for codes in knotinfo_codes(8)]
    if form == "pd":
        return cells + [str(diagram) for diagram in random_diagrams()[:20]]
    if form == "dt":
        codes = [dt_code(diagram) for diagram in random_diagrams()[:20]]
        letters = [f"DT: {dt_letters(code)}" for code in codes if len(code) <= MOST_LETTERS]
        return cells + [f"DT: [{code}]" for code in codes] + letters
    if form == "gauss":
        found = random_diagrams()[:20]
        return [
            *cells,
            *map(gauss_letters, found),
            *(str([[[*code]], [*signs]]) for code, signs in map(oriented_gauss_code, found)),
        ]
    return cells + [f"BR[{max(map(abs, word)) + 1}, {{{str(word)[1:-1]}}}]" for word in WORDS]


WORDS = [codes.words[0] for codes in knotinfo_codes(8)]
PIECES = [*"0123456789", "-", "+", ",", ";", " ", "[", "]", "(", ")", "{", "}", "X", "O", "U", "DT"]
PIECES += ["a", "B", ".", "99", "[[", "]]", "PD[", "\n", "\t", "\u2212", '"', ":", "e9", "nan", "^"]
PIECES += [
    "null",
    "true",
    "\0",
    "\U0001f600",
    "#",
    "s1",
    "1000000000000000000000000000000000000000",
]


def mutated(text: str, generator: random.Random) -> str:
    """The text with one to three mistakes: pieces put in, left out, doubled, exchanged, cut off."""
    for _ in range(generator.randint(1, 3)):
        place = generator.randrange(len(text) + 1)
        end = min(len(text), place + generator.randint(1, 6))
        kind = generator.randrange(6)
        if kind == 0:
            text = text[:place] + generator.choice(PIECES) + text[place:]
        elif kind == 1:
            text = text[:place] + text[end:]
        elif kind == 2:
            text = text[:place] + text[place:end] * 2 + text[end:]
        elif kind == 3:
            text = text[:place] + generator.choice(PIECES) + text[end:]
        elif kind == 4:
            text = text[:place] + text[place:end][::-1] + text[end:]
        else:
            text = text[:place]
    return "--" if text == "-" else text  # "-" is standard input


@pytest.mark.parametrize("form", ["pd", "dt", "gauss", "braid"])
def test_mistakes_end_in_a_knot_or_a_sentence(form: str) -> None:
    generator = random.Random(form)
    texts = examples(form)
    read = 0
    for _ in range(2000):
        text = mutated(generator.choice(texts), generator)
        try:
            understood(text)
        except KnotoptError as error:
            sentence = str(error)
            assert sentence and "\n" not in sentence and len(sentence) < 400, text
        except AssertionError:  # a grid, such as what is left of a PD code in two rows
            read += 1
        else:
            read += 1
    assert 20 < read < 1500


@settings(max_examples=25)
@given(st.sampled_from(["pd", "dt", "gauss", "braid"]), st.integers(0, 10**6))
def test_what_is_read_of_mistakes_is_drawn(form: str, seed: int) -> None:
    generator = random.Random(seed)
    text = mutated(generator.choice(examples(form)), generator)
    try:
        found = read_knot(text)
    except KnotoptError:
        return
    assert planar_diagram(found.diagram).crossings or found.diagram.size >= 2
