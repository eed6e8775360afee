# SPDX-License-Identifier: BSD-3-Clause
"""Functions written in Python, sampled into tables with a stated error."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import flat
from ._errors import one_complaint
from ._models import MODELS, Model

if TYPE_CHECKING:
    from ._arrays import FloatArray

#: Largest error of a table made without being asked for another, as a part of the value (see sampled).
_TOLERANCE = 1e-4
#: Points at first: no feature wider than a sixteenth of the domain is overlooked.
_FIRST = 17
#: Inside an interval, where the error is measured.
_INSIDE = np.arange(1, 16) / 16
_MIDDLE = 7
#: An interval this narrow, as a part of the domain, over which the function still changes has a jump in it.
_NARROWEST = 1e-9
#: Values below this part of the largest count as this.
_SMALLEST = 1e-6


@dataclass(frozen=True)
class Sampled:
    """A table that stands for a function.

    Attributes
    ----------
    model : Model
        The table, for :class:`Scene`.
    error : float
        The largest difference between function and table found at fifteen places inside every interval.
    points : int
        How many points the table has.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.sampled(lambda z: 1 + z).points
    17
    """

    model: Model
    error: float
    points: int


def sampled(
    function: Callable[[Any], Any],
    low: float = 0.0,
    high: float = 1.0,
    *,
    kind: str = "depth",
    tolerance: float = _TOLERANCE,
    max_points: int = 4000,
) -> Sampled:
    """Samples a function into a table, refined where it bends until the error is small.

    Parameters
    ----------
    function : callable
        Of height for the kinds "depth" and "start", of phi for "flux"; with arrays, or with single numbers.
    low, high : float, optional
        The ends of the domain, or of the states.
    kind : {"depth", "flux", "start"}, optional
        What it is to be: a depth function and a smooth start are linear between points, a flux is a monotone cubic.
    tolerance : float, optional
        Largest error allowed: of a depth function as a part of its value there, otherwise of the largest absolute value.
    max_points : int, optional

    Returns
    -------
    Sampled
        The model with its error. Jumps of depth functions become jumps of the table.

    Raises
    ------
    InputError
        If the function is not finite, or needs more points.

    Notes
    -----
    The cubic of a table of a convex flux may bend the other way beside an extremum, by less than the error. Then the exact
    method refuses it, which wants a flux that is convex or concave; front tracking and the finite volumes take it.

    Examples
    --------
    >>> import shearfront as sf
    >>> import numpy as np
    >>> a = sf.sampled(lambda z: np.exp(-3 * z), tolerance=1e-3)
    >>> a.error < 1e-3
    True
    >>> f = sf.sampled(lambda phi: -phi * (1 - phi) * (1 - 0.3 * phi), kind="flux")
    >>> f.model.model_name
    'table'
    """
    if kind not in ("depth", "flux", "start"):
        raise ValueError(f"kind = {kind!r}; must be 'depth', 'flux' or 'start'")
    f = _on_arrays(function, kind)
    if kind == "flux":
        return _sampled_flux(f, low, high, tolerance, max_points)
    x = np.linspace(low, high, _FIRST)
    y = f(x)
    while True:
        inside = x[:-1, None] + np.diff(x)[:, None] * _INSIDE
        values = f(inside.ravel()).reshape(inside.shape)
        errors = np.abs(values - (y[:-1, None] + np.diff(y)[:, None] * _INSIDE)).max(axis=1)
        largest = max(np.abs(y).max(), np.abs(values).max())
        sizes = np.full(len(errors), largest)
        jumps = np.zeros(len(errors), dtype=bool)  # intervals that hold one
        if kind == "depth":  # waves take times that go like 1 / a: small values count as much as large ones
            sizes = np.maximum(np.abs(values).min(axis=1), _SMALLEST * largest)
            jumps = np.diff(x) <= _NARROWEST * (high - low)
        errors[jumps] = 0
        wrong = errors > tolerance * sizes
        if not wrong.any():
            break
        _expect_room(len(x) + int(wrong.sum()), max_points, tolerance)
        middle = np.flatnonzero(wrong)
        x, y = np.insert(x, middle + 1, inside[middle, _MIDDLE]), np.insert(y, middle + 1, values[middle, _MIDDLE])
    for i in np.flatnonzero(jumps):
        x[i] = x[i + 1] = (x[i] + x[i + 1]) / 2
    model = MODELS["Table" if kind == "depth" else "TableInitial"](x, y)
    return Sampled(model, float(errors.max()), len(x))


def _sampled_flux(f: Callable[[FloatArray], FloatArray], low: float, high: float, tolerance: float, most: int) -> Sampled:
    x = _with_extrema(f, np.linspace(low, high, _FIRST))
    while True:
        y = f(x)
        inside = x[:-1, None] + np.diff(x)[:, None] * _INSIDE
        table = _core.flux_table(flat(x), flat(y), flat(inside)).reshape(inside.shape)
        errors = np.abs(f(inside.ravel()).reshape(inside.shape) - table).max(axis=1)
        wrong = np.flatnonzero(errors > tolerance * np.abs(y).max())
        if len(wrong) == 0:
            return Sampled(MODELS["FluxTable"](x, y), float(errors.max()), len(x))
        _expect_room(len(x) + len(wrong), most, tolerance)
        x = np.insert(x, wrong + 1, inside[wrong, _MIDDLE])


def _with_extrema(f: Callable[[FloatArray], FloatArray], x: FloatArray) -> FloatArray:
    """Points at the extrema: between points a table of a flux is monotone, so it has none of its own there."""
    golden = (np.sqrt(5) - 1) / 2
    y = f(x)
    for i in np.flatnonzero((np.diff(y)[:-1] < 0) != (np.diff(y)[1:] < 0)) + 1:
        sign = 1.0 if y[i] <= y[i - 1] and y[i] <= y[i + 1] else -1.0
        a, b = x[i - 1], x[i + 1]
        for _ in range(60):  # to the root of eps, where f no longer tells places apart
            c, d = b - golden * (b - a), a + golden * (b - a)
            fc, fd = f(np.array([c, d])) * sign
            a, b = (a, d) if fc < fd else (c, b)
        best = (a + b) / 2
        if sign * f(np.array([best]))[0] < sign * f(np.array([x[i]]))[0]:
            x = np.append(x, best)
    x = np.unique(x)
    # Two points closer than the search can tell are one.
    return x[np.concatenate(([True], np.diff(x) > 1e-7 * (x[-1] - x[0])))]


def _on_arrays(function: Callable[[Any], Any], kind: str) -> Callable[[FloatArray], FloatArray]:
    name = "flux" if kind == "flux" else "function"

    def f(x: FloatArray) -> FloatArray:
        try:
            y = np.asarray(function(x), dtype=float)
        except (TypeError, ValueError):
            y = np.array([float(function(float(v))) for v in x])
        if y.shape != x.shape:
            y = np.array([float(function(float(v))) for v in x]) if y.ndim == 0 else np.broadcast_to(y, x.shape)
        if not np.isfinite(y).all():
            where = float(x[~np.isfinite(y)][0])
            raise one_complaint(f"{name}({where:.12g})", float(y[~np.isfinite(y)][0]), "must be a finite number")
        return y

    return f


def _expect_room(points: int, most: int, tolerance: float) -> None:
    if points > most:
        raise one_complaint(
            "max_points", most, f"is too few for an error of {tolerance:g}; give a larger tolerance or more points"
        )


def table_of(function: Callable[[Any], Any], low: float, high: float) -> Model:
    """A function of height as a table."""
    return sampled(function, low, high).model


def initial_table(function: Callable[[Any], Any], ends: tuple[float, float]) -> Model:
    """A function of height as a smooth start."""
    return sampled(function, *ends, kind="start").model
