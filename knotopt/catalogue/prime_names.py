"""Prime knots by any of their names: 8_19, 8n_3, K8n3, Knot[8, 19]."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache

from knotopt.catalogue.knotinfo import LARGEST_KNOTS, SHIPPED_CROSSINGS, knotinfo_knots
from knotopt.catalogue.knots import PrimeKnot, shipped_knots, unknot
from knotopt.errors import require_extra

_SUBSCRIPTS = "₀₁₂₃₄₅₆₇₈₉"
_AS_DIGITS = str.maketrans(_SUBSCRIPTS, "0123456789")


def prime_named(text: str) -> PrimeKnot | None:
    """The knot of that name, KnotInfo's or another that it lists; None if there is none.

    Raises
    ------
    MissingExtraError
        A knot of 11 to 13 crossings without the `knotinfo` extra.

    Examples
    --------
    >>> [prime_named(name).name for name in ("8_19", "K8n3", "8a_11", "Knot[3, 1]", "0_1")]
    ['8_19', '8_19', '8_1', '3_1', '0_1']
    """
    name = numbered(text)
    if name is None or range_of(name) is None:
        return None
    if name in _by_any_name():
        return _by_any_name()[name]
    crossings, _, number = _parts(name)
    if crossings <= SHIPPED_CROSSINGS or not 1 <= number <= (range_of(name) or 0):
        return None
    require_extra("database_knotinfo", "knotinfo", f"knot {name!r}")
    return _of_knotinfo().get(name)


def numbered(text: str) -> str | None:
    """The name as KnotInfo writes names (8_19, 8n_3), whether such a knot exists or not.

    None for a text of another form.

    Examples
    --------
    >>> numbered("K11n34"), numbered("8₁₉"), numbered("Knot[11, NonAlternating, 34]")
    ('11n_34', '8_19', '11n_34')
    >>> numbered("trefoil")
    """
    plain = re.sub(f"[{_SUBSCRIPTS}]+", lambda low: "_" + low[0].translate(_AS_DIGITS), text)
    plain = re.sub(r"[\s{}$\\]", "", plain.casefold())
    plain = re.sub(
        r"^knot\[(\d+),(?:(non)?(a)lternating,)?(\d+)\]$",
        lambda found: f"{found[1]}{'n' if found[2] else found[3] or ''}_{found[4]}",
        plain,
    )
    found = re.fullmatch(r"(?:knot)?(?:k?(\d{1,3})([an])_?(\d{1,9})|(\d{1,3})[_.](\d{1,9}))", plain)
    if found is None:
        return None
    crossings, kind, number = found[1] or found[4], found[2] or "", found[3] or found[5]
    return f"{int(crossings)}{kind}_{int(number)}"


def range_of(name: str) -> int | None:
    """The last number of names of this form: 21 of 8_2, 367 of 11a_999; None if it has none.

    Examples
    --------
    >>> range_of("8_22"), range_of("8n_1"), range_of("11a_400"), range_of("11_1"), range_of("12_1")
    (21, 3, 367, 552, None)
    """
    crossings, kind, _ = _parts(name)
    if name == unknot().name:
        return 1
    if crossings > SHIPPED_CROSSINGS:
        return LARGEST_KNOTS.get(f"{crossings}{kind}")
    return max(
        (n for c, k, n in map(_parts, _by_any_name()) if (c, k) == (crossings, kind) and n),
        default=None,
    )


def _parts(name: str) -> tuple[int, str, int]:
    """Crossings, kind ("a", "n" or none) and number."""
    head, _, number = name.partition("_")
    return int(head.rstrip("an")), head.lstrip("0123456789"), int(number)


@cache
def _by_any_name() -> dict[str, PrimeKnot]:
    return _index([unknot(), *shipped_knots().values()])


@cache
def _of_knotinfo() -> dict[str, PrimeKnot]:
    return _index(knotinfo_knots().values())


def _index(knots: Iterable[PrimeKnot]) -> dict[str, PrimeKnot]:
    return {name: knot for knot in knots for name in (knot.name, *knot.other_names)}
