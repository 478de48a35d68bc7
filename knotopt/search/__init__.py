"""Search over the grid diagrams of a knot for few robots, few crossings and small grids."""
