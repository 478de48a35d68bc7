"""A knot by its name: KnotInfo's and others', in words, torus knots, rows of Table I, and of those
mirror images (m3_1), connected sums (3_1#m3_1) and the grids searched for them ("8_19 best3").
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from knotopt.catalogue.everyday_names import everyday_names, plain
from knotopt.catalogue.knots import PrimeKnot
from knotopt.catalogue.prime_names import numbered, prime_named
from knotopt.catalogue.stored_grids import GRIDS, stored_grid
from knotopt.catalogue.table1_grids import table1_grids
from knotopt.diagram.families import torus_knot
from knotopt.diagram.grid import GridDiagram
from knotopt.diagram.sums import connected_sum
from knotopt.errors import UnknownKnotError
from knotopt.reading.content import Content
from knotopt.reading.near_names import unknown
from knotopt.reading.record import Asked, Reading, ReadSummand

LONGEST = 200
_DEEPEST = 10  # mirror images of mirror images
_MIRROR_BEFORE = re.compile(
    r"(?:mirror(?:\s+image)?(?:\s+of)?(?![a-z])|m(?![a-z]{2})|[-\u2212])\s*", re.IGNORECASE
)
_BEST = re.compile(r"(.*?\S)\s+(?:best\s*([34])|safe\s*(0?\.25|0?\.5)?)", re.IGNORECASE)
_TORUS = re.compile(
    r"(?:t|torus|torus\s*knot)\s*(?:_\s*)?[({\[]\s*([-\u2212]?[0-9]{1,18})\s*,"
    r"\s*([-\u2212]?[0-9]{1,18})\s*[)}\]]",
    re.IGNORECASE,
)


def read(content: Content, _asked: Asked) -> Reading | None:
    """The knot of that name.

    Raises
    ------
    GridError
        A torus link of several components.
    MissingExtraError
        A knot of 11 to 13 crossings without the `knotinfo` extra.
    UnknownKnotError
        A connected sum that lacks a summand, or of which one, but not every one, is a knot; or a
        grid that is not stored.
    """
    text = content.text.strip()
    if len(text) > LONGEST or "\n" in text:
        return None
    found = _knot(text, _DEEPEST)
    return None if found is None else Reading(**vars(found))


@dataclass(frozen=True)
class _Named:
    """What is put into a `Reading`."""

    name: str
    diagram: GridDiagram
    source: str
    notes: tuple[str, ...] = ()
    prime_knot: PrimeKnot | None = None
    ambiguous: bool = False
    summands: tuple[ReadSummand, ...] = ()


def _knot(text: str, deep: int) -> _Named | None:
    """A knot, its mirror image or a connected sum, with so many brackets and signs about it."""
    text = text.strip()
    summands = _summands(text)
    if len(summands) > 1:
        return _sum(summands, deep)
    found = _single(text)
    if found is not None or not deep:
        return found
    if text.startswith("(") and text.endswith(")"):
        return _knot(text[1:-1], deep - 1)
    sign = _MIRROR_BEFORE.match(text)
    inner = text[sign.end() :] if sign else text[:-1] if text.endswith(("*", "!")) else ""
    if inner.startswith("[") and inner.endswith("]"):  # Mirror[Knot[3, 1]]
        inner = inner[1:-1]
    found = _knot(inner, deep - 1) if inner else None
    return None if found is None else _mirrored(found)


def _summands(text: str) -> list[str]:
    """The parts between the signs # that stand outside brackets."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "#" and not depth:
            parts.append("")
        else:
            parts[-1] += letter
    return parts


def _sum(texts: list[str], deep: int) -> _Named | None:
    found = [_knot(text, deep) for text in texts]
    known = [each for each in found if each is not None]
    if len(known) < len(found):
        if not all(map(str.strip, texts)):
            raise UnknownKnotError(f"{'#'.join(texts)!r} lacks a summand before or behind a sign #")
        if known:
            raise unknown(texts[found.index(None)].strip())
        return None
    knotted = [each for each in known if each.diagram.size > 2]
    if len(knotted) < 2:
        return (knotted or known)[0]
    return _Named(
        "#".join(each.name for each in knotted),
        connected_sum([each.diagram for each in knotted]),
        "connected sum",
        tuple(dict.fromkeys(note for each in knotted for note in each.notes)),
        ambiguous=any(each.ambiguous for each in knotted),
        summands=_open_summands(knotted),
    )


def _open_summands(knots: list[_Named]) -> tuple[ReadSummand, ...]:
    """The summands, if any may as well be its mirror image."""
    if not any(each.ambiguous for each in knots):
        return ()
    return tuple(
        summand
        for each in knots
        for summand in each.summands or (ReadSummand(each.diagram, each.ambiguous),)
    )


def _mirrored(knot: _Named) -> _Named:
    """The mirror image: of each summand, and of a torus knot T(p,-q)."""
    notes = knot.notes
    if knot.prime_knot is not None and knot.prime_knot.is_amphicheiral:
        notes = (*notes, f"{knot.prime_knot.name} is its own mirror image")
    return replace(
        knot,
        name=mirror_name(knot.name),
        diagram=knot.diagram.mirrored,
        notes=notes,
        prime_knot=None,
        summands=tuple(summand.mirrored for summand in knot.summands),
    )


def mirror_name(name: str) -> str:
    """The mirror image's name.

    Examples
    --------
    >>> mirror_name("3_1#m4_1"), mirror_name("T(2,-3)")
    ('m3_1#4_1', 'T(2,3)')
    """
    if "#" in name:
        return "#".join(map(mirror_name, name.split("#")))
    torus = re.fullmatch(r"T\((-?\d+),(-?)(\d+)\)", name)
    if torus:
        return f"T({torus[1]},{'' if torus[2] else '-'}{torus[3]})"
    return name.removeprefix("m") if name.startswith("m") else f"m{name}"


def _single(text: str) -> _Named | None:
    """What has a name of its own."""
    squeezed = re.sub(r"\s", "", text).casefold()
    for grid in table1_grids():
        if squeezed == grid.row.replace(" ", "").casefold():
            return _Named(grid.knot, grid.diagram, f"Table I, row {grid.row}")
    best = _BEST.fullmatch(text)
    if best:
        openness = f"{float(best[3] or 0.5):g}"
        return _stored(best[1], f"best{best[2]}" if best[2] else f"safe{openness}")
    torus = _TORUS.fullmatch(text)
    if torus:
        p, q = (int(number.replace("\u2212", "-")) for number in torus.groups())
        return _Named(f"T({p},{q})", torus_knot(p, q), "torus knot")
    knot = prime_named(text)
    if knot is not None:
        name = numbered(text)
        note = f"{name} is {knot.name} or its mirror image, here as in KnotInfo"
        notes = () if name == knot.name else (note,)
        return _Named(knot.name, knot.diagram, "KnotInfo", notes, knot)
    return _in_words(text)


def _stored(text: str, name: str) -> _Named | None:
    """A knot's grid that was searched for; of a mirror image, the grid's mirror image."""
    knot = _knot(text, _DEEPEST)
    if knot is None:
        return None
    diagram = stored_grid(knot.name, name)
    if diagram is None:
        raise UnknownKnotError(
            f"no grid {name} is stored of {knot.name}: {', '.join(GRIDS)} are of the "
            "prime knots up to 10 crossings"
        )
    return replace(knot, diagram=diagram, source=f"{knot.source}; best grid found, {GRIDS[name]}")


def _in_words(text: str) -> _Named | None:
    entry = everyday_names().get(plain(text))
    if entry is None:
        return None
    found = _knot(entry.knot, _DEEPEST)
    if found is None:
        return None
    note = f"{text} is {entry.knot}"
    if entry.either_hand:
        note += " or its mirror image, here as in KnotInfo"
    if entry.note:
        note += f" ({entry.note})"
    return replace(found, notes=(note,), ambiguous=entry.either_hand)
