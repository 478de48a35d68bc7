"""Names of knots in words: trefoil, figure-eight, granny."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from knotopt.catalogue.knots import shipped_json


@dataclass(frozen=True)
class EverydayName:
    """Names in words of one knot.

    Attributes
    ----------
    knot : str
        The knot's name in KnotInfo; m3_1 is the mirror image of 3_1, `#` a connected sum.
    names : tuple of str
        Without the word "knot", unless the name is nothing without it.
    either_hand : bool
        Whether the name is that of the mirror image as well.
    note : str
        What else there is to say; mostly nothing.
    source : str
        Who calls it that.
    """

    knot: str
    names: tuple[str, ...]
    either_hand: bool
    note: str
    source: str


@cache
def everyday_names() -> Mapping[str, EverydayName]:
    """Each name as `plain` writes it, with the entry that it stands in.

    Examples
    --------
    >>> everyday_names()[plain("Stevedore's knot")].knot
    '6_1'
    """
    entries = [
        EverydayName(names=tuple(entry.pop("names")), **entry)
        for entry in shipped_json("everyday_names.json")
    ]
    return {plain(name): entry for entry in entries for name in entry.names}


def plain(name: str) -> str:
    """A name in small letters, without blanks, hyphens, apostrophes, "the" and "knot".

    Examples
    --------
    >>> plain("the Figure-Eight Knot"), plain("P(-2, 3, 7)")
    ('figureeight', 'p(-2,3,7)')
    """
    letters = re.sub(r"(?<=\w)[-\u2010-\u2015]|[\s_.'\u2018\u2019]", "", name.casefold())
    return re.sub(r"^the(?=.)|(?<=...)knot$", "", letters)
