"""Checkers written from the definitions alone: plain Python, exact integers and rationals.

Nothing here imports `formulations` or a package that makes sets, paths or flights, and of
`knotopt.topology` only the states of ropes, not the plans: what is checked and what checks it share
no formula. A checker starts from the cable's path, or from a diagram's marks, and defines the
cable's regions by itself. Paths in space, which have no exact coordinates, are sampled finely and
measured in floating point. Which modules may hand results to which checkers stands in
`tests/test_architecture.py`.
"""
