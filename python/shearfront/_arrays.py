# SPDX-License-Identifier: BSD-3-Clause
"""Numbers on their way into the library."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    FloatArray = npt.NDArray[np.float64]


def flat(values: Any) -> FloatArray:
    """One-dimensional, contiguous and double; a copy only of what is not."""
    return np.ascontiguousarray(np.atleast_1d(np.asarray(values, dtype=np.float64)).ravel())


def times_of(t: Any) -> FloatArray:
    """Times; the word "steady" is infinity."""
    if isinstance(t, str):
        if t != "steady":
            raise ValueError(f"t = {t!r}; must be numbers or 'steady'")
        return np.array([np.inf])
    if isinstance(t, (list, tuple)):
        t = [np.inf if x == "steady" else x for x in t]
    return flat(t)


def pandas() -> Any:
    """The module, or an error that says what to install."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("tables need pandas: pip install 'shearfront[tables]'") from error
    return pandas


def xarray() -> Any:
    """The module, or an error that says what to install."""
    try:
        import xarray
    except ImportError as error:
        raise ImportError("labelled arrays need xarray: pip install 'shearfront[tables]'") from error
    return xarray
