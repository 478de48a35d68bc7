"""Checkers written from the definitions alone: plain Python, exact integers and rationals.

Nothing here imports `formulations`, `knotopt.supports` or `knotopt.cable`, so that what is checked
and what checks it share no formula. A checker starts from the cable's path.
"""
