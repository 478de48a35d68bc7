"""`python -m knotopt.catalogue`: write the shipped catalogue anew (needs the knotinfo extra)."""

from pathlib import Path

from knotopt.catalogue.knotinfo import SHIPPED_CROSSINGS, knotinfo_knots, to_json_lines
from knotopt.files import write_atomically

if __name__ == "__main__":
    path = Path(__file__).with_name("prime_knots.json")
    shipped = [k for k in knotinfo_knots().values() if k.crossing_number <= SHIPPED_CROSSINGS]
    write_atomically(path, to_json_lines(shipped))
    print(f"{len(shipped)} knots written to {path}")
