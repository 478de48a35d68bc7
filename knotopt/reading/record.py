"""What a reader finds: a diagram, and by which conventions it was read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from knotopt.catalogue.knots import PrimeKnot
from knotopt.diagram.grid import GridDiagram
from knotopt.planar.planar_diagram import PlanarDiagram
from knotopt.showing import ShownShort


@dataclass(frozen=True)
class Asked:
    """What is asked of a reader beside the knot itself.

    Attributes
    ----------
    over : str or None
        "columns" or "rows", which of a grid's segments pass over; None for the form's own way.
    form : str or None
        The one form to read the content in, by its name; None if the content decides.
    """

    over: str | None = None
    form: str | None = None


@dataclass(frozen=True)
class ReadSummand:
    """A summand of what was read.

    Attributes
    ----------
    diagram : GridDiagram or PlanarDiagram
    either_hand : bool
        Whether it may as well be its mirror image, whatever the other summands are.
    """

    diagram: GridDiagram | PlanarDiagram
    either_hand: bool

    @property
    def mirrored(self) -> ReadSummand:
        """The mirror image."""
        return ReadSummand(self.diagram.mirrored, self.either_hand)


@dataclass(frozen=True)
class Reading:
    """What one form's reader understood.

    Attributes
    ----------
    diagram : GridDiagram or PlanarDiagram
        A planar diagram is drawn on a grid afterwards.
    notes : tuple of str
        Readings chosen, a sentence's part each: "columns pass over rows", "up to mirror image".
    name : str or None
        What the knot is called, where the form says so; else it is called by its source.
    source : str or None
        Where the diagram comes from, in words, where that is not the source itself ("KnotInfo").
    prime_knot : PrimeKnot or None
        The catalogue's entry, if the knot is one of it.
    ambiguous : bool
        Whether the content may as well mean the mirror image, and one of the two was chosen.
    summands : tuple of ReadSummand
        Of an ambiguous connected sum: which of them may as well be mirror images, each by itself.
    """

    diagram: GridDiagram | PlanarDiagram
    notes: Sequence[str] = ()
    name: str | None = None
    source: str | None = None
    prime_knot: PrimeKnot | None = None
    ambiguous: bool = False
    summands: tuple[ReadSummand, ...] = ()


@dataclass(frozen=True, repr=False)
class NamedDiagram(ShownShort):
    """A grid diagram and what it was asked for by.

    Attributes
    ----------
    name : str
        The knot's name, the file's name, or what was understood ("PD code").
    diagram : GridDiagram
    source : str
        Where the diagram comes from, in words.
    prime_knot : PrimeKnot or None
        The catalogue's entry, if it was asked for by name.
    form : str
        What was understood: "name", "PD code", "matrix".
    notes : tuple of str
        Readings chosen: who passes over, from where rows are counted, "up to mirror image".
    ambiguous : bool
        Whether what was read may as well mean the mirror image, and one of the two was chosen.
    planar : PlanarDiagram or None
        The diagram that the grid was drawn from, if it was given by a code.
    summands : tuple of ReadSummand
        Of an ambiguous connected sum: which of them may as well be mirror images, each by itself.
    """

    name: str
    diagram: GridDiagram
    source: str
    prime_knot: PrimeKnot | None = None
    form: str = "grid"
    notes: tuple[str, ...] = ()
    ambiguous: bool = False
    planar: PlanarDiagram | None = None
    summands: tuple[ReadSummand, ...] = ()

    @property
    def in_words(self) -> str:
        """Name, source, grid size."""
        return f"{self.name} ({self.source}), grid of size {self.diagram.size}"
