"""Instances as files that other solvers read: MPS, OPB (pseudo-Boolean) and WCNF (MaxSAT)."""

from __future__ import annotations

from collections.abc import Iterator

from formulations.cnf import clauses
from formulations.instance import Instance


def to_mps(instance: Instance) -> str:
    """Free MPS: variables x1 ... xV are binary, rows r1 ... are A x >= b."""
    return "\n".join(_mps(instance)) + "\n"


def to_opb(instance: Instance) -> str:
    """OPB of the pseudo-Boolean competitions; row origins as comments."""
    matrix, bound = instance.matrix
    lines = [f"* #variable= {len(instance.variables)} #constraint= {len(instance.rows)}"]
    lines.append(f"* {instance.name}, instance {instance.hash}")
    weighted = enumerate(instance.objective, 1)
    lines.append("min: " + " ".join(f"+{c} x{j}" for j, c in weighted if c) + " ;")
    for number, row in enumerate(instance.rows):
        terms = zip(row.literals, matrix[[number]].data.tolist(), strict=True)
        lines.append(f"* {row.family}: {row.origin}")
        lines.append(" ".join(f"{c:+d} x{abs(x)}" for x, c in terms) + f" >= {bound[number]} ;")
    return "\n".join(lines) + "\n"


def to_wcnf(instance: Instance) -> str:
    """WCNF in the format of the MaxSAT evaluations since 2022: `h` marks hard clauses."""
    lines = [f"c {instance.name}, instance {instance.hash}"]
    lines += [f"c variable {j}: {name}" for j, name in enumerate(instance.variables, 1)]
    lines += ["h " + " ".join(map(str, (*clause, 0))) for clause in clauses(instance)]
    lines += [f"{c} {-j} 0" for j, c in enumerate(instance.objective, 1) if c]
    return "\n".join(lines) + "\n"


FORMATS = {".json": Instance.to_json, ".mps": to_mps, ".opb": to_opb, ".wcnf": to_wcnf}
"""Suffix of a file to what writes its text."""


def _mps(instance: Instance) -> Iterator[str]:
    matrix, bound = instance.matrix
    columns = matrix.tocsc()
    yield f"* {instance.name}, instance {instance.hash}"
    yield "NAME knotopt"
    yield "ROWS"
    yield " N cost"
    yield from (f" G r{i}" for i in range(1, len(instance.rows) + 1))
    yield "COLUMNS"
    yield " MARKER 'MARKER' 'INTORG'"
    for j, weight in enumerate(instance.objective):
        entries = slice(columns.indptr[j], columns.indptr[j + 1])
        yield f" x{j + 1} cost {weight}"
        for i, value in zip(columns.indices[entries], columns.data[entries], strict=True):
            yield f" x{j + 1} r{i + 1} {value}"
    yield " MARKER 'MARKER' 'INTEND'"
    yield "RHS"
    yield from (f" RHS r{i + 1} {value}" for i, value in enumerate(bound.tolist()))
    yield "BOUNDS"
    yield from (f" BV BND x{j}" for j in range(1, len(instance.variables) + 1))
    yield "ENDATA"
