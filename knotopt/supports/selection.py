"""Which supports a user means: the smallest set, LCF's, all turning points, or those in a file."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from knotopt.cable.cable import Cable
from knotopt.cable.cut import Cut, crossing_free_cuts
from knotopt.diagram.grid import GridDiagram
from knotopt.errors import FileFormatError, RequirementError
from knotopt.supports.lcf import best_cut, lcf
from knotopt.supports.minimal import minimal_supports
from knotopt.supports.requirements import Requirements
from knotopt.supports.search import best_supports
from knotopt.supports.support_set import SupportSet

CHOICES = ("milp", "lcf", "all")


@dataclass(frozen=True, repr=False)
class GivenSupports(SupportSet):
    """Supports that nobody computed here: from a file, or all turning points."""

    given_cable: Cable
    supports: tuple[int, ...]

    @property
    def cable(self) -> Cable:
        """The cable the supports belong to."""
        return self.given_cable


def choose_supports(
    diagram: GridDiagram, choice: str, cut: str = "best", requirements: Requirements | None = None
) -> SupportSet:
    """The supports that a choice stands for.

    Parameters
    ----------
    diagram : GridDiagram
    choice : str
        "milp" (the smallest set), "lcf", "all" (turning points), or the name of a `.json` file.
    cut : str
        "best", or a cut's name. The best is that of the method; for "all" the first crossing-free
        outer one; for a file the one it names.
    requirements : Requirements, optional
        Of the smallest set.

    Raises
    ------
    RequirementError
        No such choice, or no set meets the requirements.
    CutError, FileFormatError

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> diagram = read_knot("3").diagram
    >>> [choose_supports(diagram, choice, "L+").robots for choice in CHOICES]
    [5, 5, 10]
    """
    if Path(choice).suffix.lower() == ".json":
        return read_supports(Path(choice), diagram, cut)
    if choice not in CHOICES:
        names = ", ".join(CHOICES)
        raise RequirementError(
            f"supports are {names} or a .json file with a set of them, not {choice!r}"
        )
    if choice == "all":
        cable = Cable(diagram, "L+" if cut == "best" else cut)
        return GivenSupports(cable, tuple(range(2, len(cable.path))))
    if choice == "lcf":
        return best_cut(diagram) if cut == "best" else lcf(Cable(diagram, cut))
    if cut == "best":
        result = best_supports(diagram, requirements).best
    else:
        result = minimal_supports(Cable(diagram, Cut.parse(cut, diagram.size)), requirements)
    if not result.found:
        raise RequirementError(f"no set of supports meets the requirements on cut {cut}")
    return result


def equally_small(
    diagram: GridDiagram, choice: str, cut: str = "best", requirements: Requirements | None = None
) -> Iterator[SupportSet]:
    """The supports that a choice stands for, then those of other cuts that are as few.

    Found as they are asked for. Where the cut is given, or the choice is a file, there is one set.

    Parameters
    ----------
    diagram, choice, cut, requirements
        As for `choose_supports`.

    Raises
    ------
    As `choose_supports`.

    Examples
    --------
    >>> from knotopt.reading.knot import read_knot
    >>> [str(each.cable.cut) for each in equally_small(read_knot("4").diagram, "lcf")]
    ['L+', 'R-', 'B+', 'T-']
    """
    first = choose_supports(diagram, choice, cut, requirements)
    yield first
    if cut != "best" or choice not in CHOICES:
        return
    for other in crossing_free_cuts(diagram):
        if other != first.cable.cut:
            with suppress(RequirementError):  # no set at all on that cut
                found = choose_supports(diagram, choice, str(other), requirements)
                if found.robots == first.robots:
                    yield found


def read_supports(path: Path, diagram: GridDiagram, cut: str = "best") -> GivenSupports:
    """Supports from a JSON file, such as `knotopt solve --json` and `knotopt lcf --json` print.

    The file has an object with `supports`, a list of indices on the path or of [index, column,
    row], and `cut`, which `cut` overrides; a `grid`, if it has one, must be the diagram's.

    Raises
    ------
    FileFormatError
        It cannot be read, or a support is no turning point of this cable.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise FileFormatError(f"cannot read {path}: {error.strerror}") from error
    except (UnicodeDecodeError, ValueError) as error:
        raise FileFormatError(f"{path} is not JSON: {error}") from error
    if isinstance(content, list) and len(content) > 1:
        raise FileFormatError(f"{path} holds {len(content)} sets of supports: it must be one")
    if not isinstance(content, dict) or not isinstance(content.get("supports"), list):
        raise FileFormatError(f'{path} has no "supports", a list of turning points')
    marks = [list(mark) for mark in diagram.marks]
    grid = content.get("grid")
    if grid is not None and grid not in (marks, diagram.matrix.tolist()):
        raise FileFormatError(f"{path}: its grid is not the knot's")
    if cut == "best":
        cut = content.get("cut", "")
        if not isinstance(cut, str) or not cut:
            raise FileFormatError(f'{path} has no "cut"; give one with --cut')
    cable = Cable(diagram, cut)
    supports = [_support(path, cable, entry) for entry in content["supports"]]
    for index in supports:
        if supports.count(index) > 1:
            raise FileFormatError(f"{path}: two supports at p{index}")
    return GivenSupports(cable, tuple(sorted(supports)))


def _support(path: Path, cable: Cable, entry: Any) -> int:
    numbers = entry if isinstance(entry, list) else [entry]
    whole = all(isinstance(n, int) and not isinstance(n, bool) for n in numbers)
    if not whole or len(numbers) not in (1, 3):
        raise FileFormatError(
            f"{path}: a support is an index on the path or [index, column, row], not {entry!r}"
        )
    index = int(numbers[0])
    if not 1 < index < len(cable.path):
        raise FileFormatError(
            f"{path}: support p{index} is none of the turning points p2 to "
            f"p{len(cable.path) - 1} of the cable cut at {cable.cut}"
        )
    if len(numbers) == 3 and tuple(numbers[1:]) != cable.path[index - 1]:
        column, row = cable.path[index - 1]
        raise FileFormatError(
            f"{path}: support {entry} is no turning point of the cable cut at {cable.cut}, "
            f"whose p{index} is at [{column},{row}]"
        )
    return index
