"""A chain that hangs between two points at rest: where a flight starts.

Of n equal links under the weight of their joints, link k pulls with a horizontal part h, the same
for all, and a vertical part v + k. Each points along its pull; h and v are such that the chain ends
where it should, and both conditions are monotone: in v for a given h, then in h. A bight narrower
than its lowest link has no such h > 0: there its sides lean outwards instead.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

from knotopt.arrays import FloatArray, IntArray
from knotopt.errors import RequirementError

LEAST_SPACING = 5.0  # of robots in plan [radii of the cable]
ASIDE = 1.2  # of a robot that the cable starts down from it, at least [radii of the cable]
PULLS = (-20.0, 20.0)  # logarithms of horizontal pulls looked among, in weights of a joint
TAUT = 1e-12  # share of a chain's length that it may be too long and still straight
MOST_STEPS = 4000  # the most that Brent's method takes: the square of bisection's 60, about


def hanging_chain(start: FloatArray, end: FloatArray, length: float, links: int) -> FloatArray:
    """Joints of a chain of equal links that hangs at rest.

    Parameters
    ----------
    start, end : float arrays, shape (3,)
        Not one straight below the other, and no farther apart than the length; z is up.
    length : float
        Of the whole chain.
    links : int

    Returns
    -------
    float array, shape (links + 1, 3)
        From start to end.

    Examples
    --------
    >>> chain = hanging_chain(np.zeros(3), np.array([1.0, 0, 0]), 2.0, 4)
    >>> chain.round(3)[2].tolist()
    [0.5, 0.0, -0.836]
    >>> np.linalg.norm(np.diff(chain, axis=0), axis=1).round(6).tolist()
    [0.5, 0.5, 0.5, 0.5]
    """
    span = end - start
    across = float(np.hypot(span[0], span[1]))
    if length * (1 - TAUT) <= np.linalg.norm(span):
        return np.asarray(start + np.linspace(0, 1, links + 1)[:, None] * span)
    heading = np.array([span[0] / across, span[1] / across, 0.0])
    units = _directions(across / length * links, float(span[2]) / length * links, links)
    moves = units * (length / links)
    way = np.cumsum(moves[:, :1] * heading + moves[:, 1:] * np.array([0.0, 0.0, 1.0]), axis=0)
    return np.asarray(start + np.vstack((np.zeros(3), way)))


def _directions(reach: float, rise: float, links: int) -> FloatArray:
    """Directions (across, up) of hanging links, shape (links, 2); lengths are in links."""
    height = np.arange(links) - (links - 1) / 2

    def units(h: float) -> FloatArray:
        """Directions that rise as they should."""
        bound = links / 2 + h * abs(rise) / np.sqrt(links**2 - rise**2)
        v = brentq(
            lambda v: float(((v + height) / np.hypot(h, v + height)).sum()) - rise,
            -bound,
            bound,
            xtol=1e-15,
            maxiter=MOST_STEPS,
        )
        pulls = np.column_stack((np.full(links, h), v + height))
        return np.asarray(pulls / np.hypot(pulls[:, :1], pulls[:, 1:]))

    def beyond(log: float) -> float:
        return float(units(np.exp(log))[:, 0].sum()) - reach

    if beyond(PULLS[0]) > 0:
        return _leaning(reach, rise, links)
    return units(np.exp(brentq(beyond, *PULLS, maxiter=MOST_STEPS)))


def _leaning(reach: float, rise: float, links: int) -> FloatArray:
    """Directions of links on either side of a lowest one that is wider than the reach.

    All lean outwards by the same angle, as much as makes room for the lowest.
    """
    lowest = int(np.clip(round((links - 1 - rise) / 2), 0, links - 1))
    ups = np.sign(np.arange(links) - lowest)

    def bottom(lean: float) -> tuple[float, float]:
        up = float(np.clip(rise - ups.sum() * np.cos(lean), -1, 1))
        return np.sqrt(1 - up**2), up

    def beyond(lean: float) -> float:
        return float(bottom(lean)[0] - (links - 1) * np.sin(lean) - reach)

    lean = brentq(beyond, 0.0, np.arcsin(1 / (links - 1)), xtol=1e-15, maxiter=MOST_STEPS)
    directions: FloatArray = np.column_stack((np.full(links, -np.sin(lean)), ups * np.cos(lean)))
    directions[lowest] = bottom(lean)
    return directions


def hung_apart(
    start: FloatArray, end: FloatArray, length: float, links: int, apart: float
) -> FloatArray:
    """A hanging chain whose first and last inner joints are aside of its ends.

    The bights of a cable on either side of a robot would touch each other below it where they are
    narrow; so they start a little apart.

    Parameters
    ----------
    apart : float
        How far aside, at least, where there is room for that.

    Examples
    --------
    >>> chain = hung_apart(np.zeros(3), np.array([0.3, 0, 0]), 2.0, 20, 0.02)
    >>> chain[[1, -2], 0].round(6).tolist()
    [0.02, 0.28]
    """
    chain = hanging_chain(start, end, length, links)
    link = length / links
    heading = (end - start) * [1.0, 1.0, 0.0]
    across = float(np.linalg.norm(heading))
    heading /= across
    apart = min(apart, (across - 1.1 * link) / 2)  # a link fits in between
    if min((chain[1] - start) @ heading, (end - chain[-2]) @ heading) >= apart:
        return chain
    move = apart * heading
    drop = np.array([0.0, 0.0, np.sqrt(link**2 - apart**2)])
    first, last = start + move - drop, end - move - drop
    if np.linalg.norm(last - first) >= length - 2 * link:
        return chain
    inner = hanging_chain(first, last, length - 2 * link, links - 2)
    return np.vstack((start, inner, end))


def check_start(start: FloatArray, lengths: FloatArray, radius: float) -> None:
    """Refuse starts that no cable can hang between.

    Raises
    ------
    RequirementError
        Not positions and lengths of cable, or robots too close or too far apart.
    """
    if start.ndim != 2 or start.shape[1:] != (3,) or len(start) < 2:
        raise RequirementError(f"two robots or more start at points [x, y, z], not {start.shape}")
    if lengths.shape != (len(start) - 1,):
        raise RequirementError(
            f"between {len(start)} robots there are {len(start) - 1} lengths of cable, "
            f"not {lengths.shape}"
        )
    if not np.isfinite(start).all() or not np.isfinite(lengths).all():
        raise RequirementError("starts and lengths of cable are finite numbers")
    least = LEAST_SPACING * radius
    for k, (span, length) in enumerate(zip(np.diff(start, axis=0), lengths.tolist(), strict=True)):
        names = f"robots {k + 1} and {k + 2}"
        across, apart = np.hypot(span[0], span[1]), np.linalg.norm(span)
        if across < least:
            raise RequirementError(
                f"{names} start {across:.3f} m apart in plan; a cable of radius "
                f"{radius:g} m between them takes {least:g} m"
            )
        if not length > apart:
            raise RequirementError(
                f"{names} start {apart:.3f} m apart, but the cable between them is "
                f"{length:.3f} m long"
            )


def cable_at_rest(
    start: FloatArray, held: IntArray, edge_lengths: FloatArray, radius: float
) -> FloatArray:
    """A cable that hangs between robots, shape (M, 3) [m].

    Parameters
    ----------
    start : float array, shape (R, 3)
        Positions of the robots [m].
    held : int array, shape (R,)
        Vertex that each robot holds.
    edge_lengths : float array, shape (M - 1,)
        Equal between two robots [m].
    radius : float
        Of the cable [m].
    """
    chains = [start[:1]]
    for k, (first, last) in enumerate(zip(held[:-1].tolist(), held[1:].tolist(), strict=True)):
        length = float(edge_lengths[first:last].sum())
        chain = hung_apart(start[k], start[k + 1], length, last - first, ASIDE * radius)
        chains.append(chain[1:])
    return np.concatenate(chains)
