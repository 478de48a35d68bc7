"""Mathematical programs that know no knots: sets, matrices, bounds, and the solvers for them.

Nothing here imports `knotopt`, which compiles its diagrams into these programs.
"""
