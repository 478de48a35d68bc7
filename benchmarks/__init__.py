"""Benchmarks of knotopt: `python -m benchmarks run`, then `python -m benchmarks plot`."""
