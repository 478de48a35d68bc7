"""Pictures, by matplotlib: importing anything from here needs the `viz` extra."""

from knotopt.errors import MissingExtraError

try:
    import matplotlib  # noqa: F401
except ImportError as error:
    raise MissingExtraError("matplotlib", "viz", "drawing pictures") from error
