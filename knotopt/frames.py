"""Tables as data frames of pandas, where that is installed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from knotopt.errors import require_extra

if TYPE_CHECKING:
    import pandas as pd


def data_frame(rows: Iterable[Mapping[str, Any]], columns: Sequence[str]) -> pd.DataFrame:
    """Rows under the names of their columns, in that order.

    Raises
    ------
    MissingExtraError
        pandas is not installed.

    Examples
    --------
    >>> data_frame([{"knot": "3_1", "crossings": 3}], ["knot", "crossings"]).shape
    (1, 2)
    """
    require_extra("pandas", "pandas", "a data frame")
    import pandas as pd

    return pd.DataFrame.from_records(list(rows), columns=list(columns))
