"""Topological states of a rope on a plane, the actions between them, and plans to a goal.

Source: Yan, Li, Zhu and Bohg, "Learning topological motion primitives for knot planning", IROS
2020, arXiv:2009.02615, sections III and IV.
"""
