"""Pictures, by matplotlib: importing anything from here needs the `viz` extra."""

from knotopt.errors import require_extra

require_extra("matplotlib", "viz", "drawing pictures")
