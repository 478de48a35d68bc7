"""A cable of the aerial team as a rope, and the leader's flight as a plan.

The cable's ends p_1 ... p_2N are the rope's, in this order. The leader carries the last end from
p_1 to p_2N and makes each crossing when it comes there the second time, so the crossings are made
in the order of their second visits, each by the last segment: by C, or by R1 if the strand crossed
is of that segment too.
"""

from __future__ import annotations

from bisect import bisect, insort
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from networkx.utils import UnionFind

from knotopt.arrays import BoolArray, IntArray
from knotopt.cable.cable import Cable, frozen
from knotopt.supports.regions import Regions
from knotopt.topology.actions import R1, Action, C
from knotopt.topology.cable_state import cable_state
from knotopt.topology.faces import dart_faces
from knotopt.topology.legal import apply
from knotopt.topology.plan import Plan
from knotopt.topology.state import TRIVIAL, RopeState


def laid_plan(state: RopeState) -> Plan:
    """The plan that lays a rope down from its first end to its last, crossing by crossing.

    Every action is checked to be legal before it is taken.

    Raises
    ------
    RopeActionError
        The code is not that of a rope in the plane.

    Notes
    -----
    O(n) for each of n crossings.
    """
    done: list[int] = []  # visits, in order, of the crossings made so far
    actions: list[Action] = []
    states = [TRIVIAL]
    for visit, entry in enumerate(state.code):
        partner = entry >> 2
        if partner > visit:
            continue
        last, other = len(done), bisect(done, partner)
        over, sign = entry & 2, 2 * (entry & 1) - 1
        if other == last:
            actions.append(R1(last, sign if over else -sign, sign))
        else:
            actions.append(C(last, other, sign) if over else C(other, last, sign))
        states.append(apply(states[-1], actions[-1]))
        insort(done, partner)
        done.append(visit)
    return Plan(tuple(actions), tuple(states))


def flown_plan(cable: Cable) -> Plan:
    """The plan that the leader's flight along a cable carries out.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> print(flown_plan(Cable(torus_knot(2, 3), "L+")))
    R1(0,-1,1) C(2,1,1) C(2,4,1)
    """
    return laid_plan(cable_state(cable))


@dataclass(frozen=True, eq=False)
class LeaderFaces:
    """The faces that the leader flies into, beside the regions of the Loop Consistency Filter.

    Action k = 1 ... n of the flown plan takes the leader from the face beside the last segment into
    another one, where it stays until action k + 1 takes it out again, or for good if k = n. Unless
    it is the face outside, that face must be open from one action to the next. Faces are followed
    through all later actions as sets of the final state's faces: the leader only ever divides them.
    A region is closed by the action that completes its boundary, and its interior is the union of
    the faces of the state then that the boundary parts from the face outside.

    Attributes
    ----------
    regions : Regions
        The cable's R regions.
    closing : int array, shape (R,)
        The action that closes each region.
    inner : bool array, shape (n,)
        Whether the face after each action is another one than that outside.
    inside : bool array, shape (R, n)
        Whether that face lies in the interior of each region, closed by then.

    Notes
    -----
    What is required by the plan and what is active agree, up to how much of a strand counts:

    - Every inner face lies in a loop. (Take the shortest stretch of the flight whose curve parts
      the face from outside. If its ends were not of one crossing, each would close its own gap
      across the face left without the two; two disjoint arcs across a disc part two points only if
      one of them does, so a shorter stretch would do.) So if the leader turns in it, the loop is
      active. If not, the leader passes straight, over both strands along a column or under both
      along a row: the face may lie in passive regions only, and these need no opening.
    - An active region is entered, by the action that closes it or a later one, unless what makes
      it active is a turning point between the two strands of a pocket that was laid before the
      pocket closed, or one in a bay of the boundary whose neck is a single grid step wide, which
      the filter's flood fill takes for interior.

    Over the 249 knots of the catalogue and their 2,042 crossing-free cuts: of 29,120 actions 15,538
    lead into an inner face, 15,410 of these into one in an active region and 128 straight across
    one in passive regions only; all 23,626 active regions are entered, 615 of them by nothing but
    the action that closes them. But 4,198 of the 18,007 passive regions are entered too, always
    straight across. On 4,898 cables of random grids of sizes 5 to 15: 1,918 of 12,723 inner faces
    lie in passive regions only; 53 of 13,258 active regions are not entered, 44 pockets and 9
    loops, for the reasons above.
    """

    regions: Regions
    closing: IntArray
    inner: BoolArray
    inside: BoolArray

    @cached_property
    def is_active(self) -> BoolArray:
        """Which regions are active, shape (R,)."""
        return frozen(self.regions.threaded_by >= 0)

    @property
    def kept_open(self) -> BoolArray:
        """Whether the face after each action lies in an active region, shape (n,)."""
        return np.asarray(self.inside[self.is_active].any(axis=0))

    @property
    def is_entered(self) -> BoolArray:
        """Whether an action leads into each region, when it closes or later, shape (R,)."""
        return np.asarray(self.inside.any(axis=1))


def leader_faces(cable: Cable) -> LeaderFaces:
    """The faces that the leader flies into, and the regions of a cable that they lie in.

    Notes
    -----
    O(n) for each of the regions and actions, fewer than 3 n, of n crossings.

    Examples
    --------
    >>> from knotopt.diagram.families import torus_knot
    >>> faces = leader_faces(Cable(torus_knot(2, 3), "L+"))
    >>> faces.inner.tolist(), faces.kept_open.tolist()
    ([False, True, False], [False, True, False])
    >>> faces.is_active.tolist(), faces.is_entered.tolist()
    ([True, True, False, False, False], [True, True, False, False, False])
    """
    regions = Regions(cable)
    boundaries = regions.boundaries
    code = cable_state(cable).code
    face = dart_faces(code)
    outside = _outer_dart(cable)
    last = len(code)
    second = [visit for visit, entry in enumerate(code) if entry >> 2 < visit]

    # The leader is on segment v + 1 after the action of visit v.
    inner = np.zeros(len(second), dtype=bool)
    for action, visit in enumerate(second):
        joined = _joined(face, range(visit + 1, last + 1))
        inner[action] = joined[2 * visit + 2] != joined[outside]

    times = cable.visits[0]
    ends = np.searchsorted(times, np.hstack((boundaries.a, boundaries.b)))
    complete = np.where(boundaries.is_pocket, ends[:, 3], ends[:, 1])
    closing = np.searchsorted(second, complete) + 1
    inside = np.zeros((len(regions), len(second)), dtype=bool)
    for region, (a0, a1, b0, b1) in enumerate(ends.tolist()):
        on = {*range(a0 + 1, a1 + 1)}
        if boundaries.is_pocket[region]:
            on |= {*range(b0 + 1, b1 + 1)}
        joined = _joined(face, (segment for segment in range(last + 1) if segment not in on))
        for action in range(int(closing[region]) - 1, len(second)):
            inside[region, action] = joined[2 * second[action] + 2] != joined[outside]
    return LeaderFaces(regions, frozen(closing), frozen(inner), frozen(inside))


def _joined(face: list[int], removed: Iterable[int]) -> list[int]:
    """The face on the left of each dart when some segments are taken away."""
    joined = UnionFind(face)
    for segment in removed:
        joined.union(face[2 * segment], face[2 * segment + 1])
    return [joined[number] for number in face]


def _outer_dart(cable: Cable) -> int:
    """A dart with the face outside on its left: beside the lowest leftmost turning point."""
    path = cable.path
    point = min(range(len(path)), key=path.__getitem__)
    segment = int(np.searchsorted(cable.visits[0], cable.times[point]))
    if point in {0, len(path) - 1}:
        return 2 * segment
    (x0, y0), (x1, y1), (x2, y2) = path[point - 1 : point + 2]
    turns_left = (x1 - x0) * (y2 - y1) > (y1 - y0) * (x2 - x1)
    return 2 * segment + turns_left
