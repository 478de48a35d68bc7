"""Flights in physics (extra `sim`). A simulator's package is imported when a flight is flown."""
