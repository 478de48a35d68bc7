"""Checkers written from the definitions alone: plain Python, exact integers and rationals.

Nothing here imports `formulations`, `knotopt.supports`, `knotopt.path` or `knotopt.cable`, so that
what is checked and what checks it share no formula. A checker starts from the cable's path. Paths
in space, which have no exact coordinates, are sampled finely and measured in floating point.
"""
