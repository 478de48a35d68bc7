"""Reports of an atlas: importing anything from here needs the `atlas` and `viz` extras."""

import knotopt.atlas.store
import knotopt.plot  # noqa: F401
