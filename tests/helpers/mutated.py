"""Inputs of every form, damaged at random, for a reader that must answer whatever it is given.

`python -m tests.helpers.mutated 10000` tries so many, each in at most 30 s and 4 GiB, and prints
what it found wrong.
"""

from __future__ import annotations

import random
import resource
import signal
import sys
import traceback
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from knotopt.errors import KnotoptError
from knotopt.reading.knot import read_knot
from knotopt.reading.source import decode

INPUTS = Path(__file__).parents[1] / "data/inputs"
SECONDS, BYTES = 30, 4 << 30
OTHERS = (
    "8_19",
    "T(2,7)",
    "7 Var1",
    "K11n34",
    "m3_1",
    "3_1#4_1",
    "Braid[3, {1, -2, 1, -2}]",
    "s1 s2^-1 s1 s2^-1",
    "PD[X[1, 5, 2, 4], X[3, 1, 4, 6], X[5, 3, 6, 2]]",
    "X = [4, 0, 1, 2, 3]\nO = [1, 2, 3, 4, 0]\ngridlist = [\n  [0, 1]]\nmoves = []\n",
    '{"knot": "mine", "grid": [[1, 1], [1, 2], [2, 1], [2, 2]], "pd_code": []}',
    "GridDiagram(minus=(1, 5, 4, 3, 2), plus=(4, 3, 2, 1, 5))",
    "trivial",
)
ALPHABET = "0123456789-+.,;:|_ \t\n[](){}\"'#XOUxoabcDTPBR/^eE=\u2212\u00a0\0\u00e9"


def seeds() -> list[str]:
    """Texts that are knots, or nearly."""
    texts = [decode(path.read_bytes(), path.name) for path in sorted(INPUTS.iterdir())]
    return [*texts, *OTHERS]


def mutated(count: int, seed: int = 0) -> Iterator[str]:
    """So many damaged texts; the same seed gives the same ones."""
    generator = random.Random(seed)
    texts = seeds()
    for _ in range(count):
        text = generator.choice(texts)
        for _ in range(generator.choice((1, 1, 1, 2, 3, 8))):
            text = _damaged(text, texts, generator)
        yield text


def _damaged(text: str, texts: list[str], generator: random.Random) -> str:
    """A text with one piece of it changed, its lines in disorder, or the end of another one."""
    place = generator.randrange(len(text) + 1)
    end = min(len(text), place + generator.choice((1, 1, 2, 5, 20)))
    signs = "".join(generator.choices(ALPHABET, k=generator.choice((1, 1, 2, 4))))
    number = str(generator.choice((0, 1, -1, 2, 7, 99, 10**6, -(10**9), 10**20, 0.5)))
    piece, times = text[place:end], generator.choice((2, 4, 50))
    lines, other = text.split("\n"), generator.choice(texts)
    generator.shuffle(lines)
    opening, closing = generator.choice(("[]", "()", "{}", '""', "[[", "X["))
    pieces = ("", piece + signs, signs, piece * times, number, piece[::-1])
    wholes = (
        "\n".join(lines[: generator.randrange(len(lines)) + 1]),
        text[:place] + other[generator.randrange(len(other) + 1) :],
        opening + text + closing,
    )
    if generator.random() < len(pieces) / (len(pieces) + len(wholes)):
        return text[:place] + generator.choice(pieces) + text[end:]
    return generator.choice(wholes)


def answer(text: str) -> str:
    """What reading a text comes to: "knot" or "sentence"; anything else is an error of ours.

    Raises
    ------
    AssertionError
        The message is not one sentence, or what was read is no knot.
    """
    try:
        found = read_knot(text)
    except KnotoptError as error:
        assert 0 < len(str(error)) < 1200 and "\n" not in str(error), str(error)
        return "sentence"
    assert found.diagram.size >= 2 and found.form
    return "knot"


def _try(count: int = 10_000, seed: int = 0) -> int:
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    signal.signal(signal.SIGALRM, _too_long)
    found: Counter[str] = Counter()
    for text in mutated(count, seed):
        signal.alarm(SECONDS)
        try:
            found[answer(text)] += 1
        except Exception:
            found["wrong"] += 1
            print(repr(text[:2000]), traceback.format_exc(limit=-3), sep="\n")
        signal.alarm(0)
    print(dict(found))
    return 1 if found["wrong"] else 0


def _too_long(*_: object) -> None:
    raise TimeoutError(f"more than {SECONDS} s")


if __name__ == "__main__":
    sys.exit(_try(*map(int, sys.argv[1:])))
