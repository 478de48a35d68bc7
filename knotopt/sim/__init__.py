"""Flights in physics (extra `sim`). MuJoCo is imported when a flight is first simulated."""
