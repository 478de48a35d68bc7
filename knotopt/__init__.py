"""knotopt: smallest robot teams that tie a knot in a cable in midair.

The public names are listed in `__init__.pyi` and imported when first used, so that
`import knotopt` costs next to nothing.

Examples
--------
>>> import knotopt
>>> result = knotopt.best_cut(knotopt.read("8_19").diagram)
>>> result.baseline, result.robots
(14, 10)
"""

import lazy_loader

__version__ = "0.2.0"

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
