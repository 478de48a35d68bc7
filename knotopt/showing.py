"""How results show themselves in Python: a line for `repr`, a picture in a notebook and by `plot`.

Pictures are drawn by `knotopt.plot`, which is made of all results, so that none of them can import
it: it is found by its name when a picture is asked for.
"""

from __future__ import annotations

import base64
import html
import importlib
from typing import TYPE_CHECKING

from knotopt.errors import MissingExtraError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURES = "knotopt.plot.pictures"
"""The module that has a picture of every result."""


class Shown:
    """A result that has a picture."""

    def plot(self, title: str = "") -> Figure:
        """The picture, by matplotlib (the `viz` extra).

        Parameters
        ----------
        title : str
            By default what the result says of itself.

        Returns
        -------
        matplotlib.figure.Figure
            Its `savefig` writes it; its `axes` can be drawn on.

        Raises
        ------
        MissingExtraError
            matplotlib is not installed.
        """
        figure: Figure = importlib.import_module(PICTURES).picture(self, title)
        return figure

    def _repr_html_(self) -> str:
        """The picture for a notebook, and below it what `repr` says; without matplotlib, text."""
        words = f"<pre>{html.escape(repr(self))}</pre>"
        try:
            drawn: bytes = importlib.import_module(PICTURES).picture_svg(self)
        except MissingExtraError:
            return f"<pre>{html.escape(str(self))}</pre>"
        code = base64.b64encode(drawn).decode()
        return f'<img alt="" src="data:image/svg+xml;base64,{code}"/>{words}'


class ShownShort(Shown):
    """A result with arrays or parts inside, whose `repr` is a line about it."""

    @property
    def in_words(self) -> str:
        """What the result is, in a line."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.in_words}>"


def plural(count: int, what: str) -> str:
    """`1 robot`, `2 robots`."""
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
