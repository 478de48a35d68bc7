from .cable.alexander import alexander_polynomial as alexander_polynomial
from .cable.alexander import determinant as determinant
from .cable.cable import Cable as Cable
from .cable.cut import Cut as Cut
from .cable.cut import crossing_free_cuts as crossing_free_cuts
from .cable.cut import outer_cuts as outer_cuts
from .cable.notation import dt_code as dt_code
from .cable.notation import gauss_code as gauss_code
from .cable.notation import pd_code as pd_code
from .cable.staircase import find_staircases as find_staircases
from .catalogue.knotinfo import knotinfo_knots as knotinfo_knots
from .catalogue.knots import shipped_knots as shipped_knots
from .catalogue.lookup import find_knot as find_knot
from .catalogue.table1_grids import table1_grids as table1_grids
from .diagram.families import random_knot as random_knot
from .diagram.families import torus_knot as torus_knot
from .diagram.grid import GridDiagram as GridDiagram
from .diagram.reading import read_grid as read_grid
from .diagram.simplify import simplify as simplify
from .errors import KnotoptError as KnotoptError
from .supports.lcf import LcfResult as LcfResult
from .supports.lcf import best_cut as best_cut
from .supports.lcf import lcf as lcf
from .supports.lcf import lcf_by_cut as lcf_by_cut
from .supports.regions import Region as Region
from .supports.regions import Regions as Regions

__version__: str
