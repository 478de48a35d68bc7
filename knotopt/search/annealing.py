"""Simulated annealing over the grids of a knot: one run, on integers alone.

Source: Kirkpatrick, Gelatt, Vecchi, "Optimization by simulated annealing",
doi:10.1126/science.220.4598.671; the moves are those of `lines`, so every grid met is one of the
same knot.
"""

from __future__ import annotations

from knotopt.search.lines import (
    Lines,
    commute,
    copy_grid,
    destabilise,
    invert,
    stabilise,
    trace,
    translate,
    transposed,
)
from knotopt.search.loops import NONE, fewest_robots, find_crossings

NOTHING, WHOLE = -1, -2
"""What became of a move that is no commutation: none was possible, or the grid was made anew."""

DRAWN = 2147483562
"""Numbers drawn lie below it."""

SIZES = 128
"""What a kept grid's crossings are counted in, so that equal ones are in the order of size."""


def anneal(
    lines: Lines,
    spare: Lines,
    state: list[int],
    plan: list[int],
    chances: list[int],
    work: tuple[list[int], list[int]],
    best: list[int],
    kept: list[int],
) -> int:
    """Walk from a grid to grids of little energy: robots, crossings and size, each by its weight.

    Parameters
    ----------
    lines : Lines
        The grid, its marks by column and by row; changed.
    spare : Lines
        As large.
    state : list of int
        Grid size, and the two numbers of `draw`; changed.
    plan : list of int
        Steps, largest size, levels of temperature, energies of a level, and the weights of a robot,
        a crossing and a line.
    chances : list of int, length levels x energies
        Of each level and rise of energy, below what number drawn a step is taken.
    work : two lists of int, each twice as long as the largest size
    best : list of int
        For each number of robots the least crossings * `SIZES` + size met; changed.
    kept : list of int
        For each number of robots such a grid, the rows of the marks of its columns; changed.

    Returns
    -------
    int
        How many grids were looked at.
    """
    steps, max_size, levels, energies = plan[0], plan[1], plan[2], plan[3]
    per_robot, per_crossing, per_line = plan[4], plan[5], plan[6]
    size, energy, looked = state[0], NONE, 0
    trace(lines, size)
    for step in range(steps):
        done = make_move(lines, state, max_size) if step else WHOLE
        if done == NOTHING:
            continue
        looked += 1
        level = step * levels // steps * energies
        chance = draw(state, DRAWN)
        crossings = find_crossings(lines, state[0], work[0])
        rise = per_crossing * crossings + per_line * state[0] - energy
        robots = 3 if crossings else 2  # at least, by which most steps are refused
        taken = is_taken(rise + per_robot * robots, chance, level, energies, chances)
        if taken:
            robots = fewest_robots(state[0], work[0], work[1])
            rise += per_robot * robots
            taken = is_taken(rise, chance, level, energies, chances)
        if taken:
            energy += rise
            size = state[0]
            if done == WHOLE:
                copy_grid(lines, spare, size)
            keep(lines, size, robots, crossings, best, kept)
        elif done == WHOLE:
            copy_grid(spare, lines, size)
            state[0] = size
        else:  # a commutation undoes itself
            commute(transposed(lines) if done % 2 else lines, size, done // 2)
    return looked


def is_taken(rise: int, chance: int, level: int, energies: int, chances: list[int]) -> bool:
    """Whether a step that raises the energy so much is taken."""
    return rise <= 0 or (rise < energies and chance < chances[level + rise])


def keep(
    lines: Lines, size: int, robots: int, crossings: int, best: list[int], kept: list[int]
) -> None:
    """Keep the grid if it has fewer crossings, or is smaller, than the others of its robots."""
    if robots < len(best) and crossings * SIZES + size < best[robots]:
        best[robots] = crossings * SIZES + size
        start = robots * (len(kept) // len(best))
        for column in range(size):
            kept[start + 2 * column] = lines[0][column]
            kept[start + 2 * column + 1] = lines[1][column]


def make_move(lines: Lines, state: list[int], max_size: int) -> int:
    """Make a move drawn by lot; a commutation is returned as 2 * line + 1 for rows, + 0 else.

    Of a hundred moves 74 are commutations, 6 translations, 8 stabilisations, 12 destabilisations;
    as many are of rows as of columns.
    """
    size = state[0]
    of_rows = draw(state, 2)
    view = transposed(lines) if of_rows else lines
    kind = draw(state, 100)
    if kind < 74:
        line = draw(state, size)
        return 2 * line + of_rows if commute(view, size, line) else NOTHING
    if kind < 80:
        translate(view, size, draw(state, size), draw(state, size))
    elif kind < 88:
        if size == max_size:
            return NOTHING
        stabilise(view, size, draw(state, size), draw(state, 4), draw(state, 2) == 1)
        state[0] = size + 1
    else:
        if not destabilise(view, size, draw(state, size)):
            return NOTHING
        state[0] = size - 1
    invert(view, state[0])
    trace(lines, state[0])
    return WHOLE


def draw(state: list[int], below: int) -> int:
    """A number from 0 to `below` - 1.

    Two multiplicative generators combined; no product leaves 64 bits. Source: L'Ecuyer, "Efficient
    and portable combined random number generators", doi:10.1145/62959.62969.
    """
    state[1] = state[1] * 40014 % 2147483563
    state[2] = state[2] * 40692 % 2147483399
    difference = state[1] - state[2]
    return (difference if difference > 0 else difference + DRAWN) % below
