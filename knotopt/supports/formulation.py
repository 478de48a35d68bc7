"""What the package knows of a formulation, in one record each; `registry` lists them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Generic, TypeVar

from formulations.canonical import Program
from formulations.instance import Instance
from formulations.team import Team
from knotopt.cable.cable import Cable
from knotopt.supports.regions import Regions
from knotopt.supports.threading import Threading
from knotopt.verify.definition import Checker
from knotopt.verify.registry import DEFINITIONS

P = TypeVar("P", bound=Program)
P_co = TypeVar("P_co", bound=Program, covariant=True)


@dataclass(frozen=True)
class Claim(Generic[P_co]):
    """On one cable, `robots` - 1 robots are too few: what a certificate proves of each cut.

    Attributes
    ----------
    cable : Cable
    program : Program
        The formulation's, of this cable.
    instance : Instance
        The program's, for the openness.
    openness : Fraction
    robots : int
    """

    cable: Cable
    program: P_co
    instance: Instance
    openness: Fraction
    robots: int


@dataclass(frozen=True)
class Formulation(Generic[P]):
    """One formulation.

    Attributes
    ----------
    name : str
    words : str
        What must survive, for the reader.
    compile : callable
        Makes the program of a cable from its regions, what threads them, what the team asks beyond
        openness, and the turning points (1-based) of a first guess.
    threading : tuple of Threading
        The modes that it has, the default first.
    proofs : mapping of str to callable
        Makers of a certificate's proofs, by the method's name, the default first: each takes a
        `Claim` and gives what goes into the certificate, or raises `CertificateError`.
    openness : Fraction
        Default r [grid steps].
    threads_once : bool
        Whether a strand threads a region only where it first turns inside.
    is_taut : bool
        Whether it is about the taut cable, straight between robots, which pictures then show.
    has_openness : bool
        Whether its sets depend on r.
    adjective : str
        What a set is that meets it.
    meaning : str
        What its smallest number is, and is not, for the reader; "" where `words` say it all.
    with_loops : bool
        Whether a support on every loop is asked for, too, where nothing is said of it.
    """

    name: str
    words: str
    compile: Callable[[Regions, Threading, Team, tuple[int, ...]], P]
    threading: tuple[Threading, ...]
    proofs: Mapping[str, Callable[[Claim[P]], dict[str, Any]]]
    openness: Fraction = Fraction(1, 2)
    threads_once: bool = False
    is_taut: bool = False
    has_openness: bool = True
    adjective: str = "open"
    meaning: str = ""
    with_loops: bool = False

    def checker(self, *, with_loops: bool) -> Checker:
        """Examines a set by the definition, as the checkers' own table has it."""
        return DEFINITIONS[self.name].checker(with_loops=with_loops)
