# SPDX-License-Identifier: BSD-3-Clause
"""Profiles of the misfit along one unknown or two, the others at their best."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import NoResult, one_complaint

if TYPE_CHECKING:
    from ._arrays import FloatArray
    from ._estimate import Fit

_SHARE = 0.95
_MOST_EVALUATIONS = 60  # of a search for the other unknowns


@dataclass(frozen=True)
class MisfitProfile:
    """The least misfit at values of one unknown or two.

    Attributes
    ----------
    names : tuple of str
        One unknown or two.
    grid : tuple of ndarray
        Their values.
    increase : ndarray
        By how much the least misfit there exceeds that of the estimate, one axis for each unknown; NaN where the model has no
        solution, or the search for the other unknowns did not end.
    level : float
        The increase where the 95 % region of these unknowns ends, both at once if there are two.
    estimates : tuple of float
        Of these unknowns.
    evaluations : int
        Runs of the forward model.

    Examples
    --------
    >>> import shearfront as sf
    >>> bed = sf.Scene(shear_rate=sf.Piecewise([0.6], [1.4, 0.6]), initial=sf.Step(0.5))
    >>> seen = bed.observe([0.2, 0.5, 1], [0.1, 0.3, 0.5, 0.7, 0.9], quantity="cumulative", noise=0.01)
    >>> curve = sf.fit(bed, seen, ["shear_rate.values"]).profile_curve("shear_rate.values[0]", points=5)
    >>> len(curve.grid[0]), bool(curve.increase.min().round(3) == 0), round(curve.level, 2)
    (5, True, 1.92)
    """

    names: tuple[str, ...]
    grid: tuple[FloatArray, ...]
    increase: FloatArray
    level: float
    estimates: tuple[float, ...]
    evaluations: int


def profile_of(found: Fit, names: tuple[str, ...], points: int, reach: float) -> MisfitProfile:
    """See :meth:`Fit.profile_curve` and :meth:`Fit.profile_surface`."""
    if found.facts["loss"] != "squared":
        raise one_complaint("loss", found.facts["loss"], "must be squared: a profile needs a misfit that is a sum of squares")
    misfit = found.problem.misfit
    for name in names:
        if name not in misfit.names:
            raise one_complaint("name", name, f"must be one of: {', '.join(misfit.names)}")
    if len(set(names)) < len(names):
        raise one_complaint("name", names[-1], "must be another unknown")
    search = _Search(found, [misfit.names.index(name) for name in names])
    axes = [search.axis(i, points, reach) for i in range(len(names))]
    shape = tuple(len(axis) for axis in axes)
    least = np.full(shape, np.nan)
    solved: dict[tuple[int, ...], tuple[FloatArray, FloatArray, FloatArray]] = {}
    middle = tuple(int(np.argmin(np.abs(axis - x))) for axis, x in zip(axes, search.estimate[search.fixed], strict=True))
    # Outwards, each place from its neighbour towards the estimate.
    places = sorted(np.ndindex(shape), key=lambda place: sum(abs(i - m) for i, m in zip(place, middle, strict=True)))
    for place in places:
        inner = tuple(
            i - np.sign(i - m) * _is_farthest(place, middle, k) for k, (i, m) in enumerate(zip(place, middle, strict=True))
        )
        at = solved.get(inner, search.start)
        now = search.run(np.array([axis[i] for axis, i in zip(axes, place, strict=True)]), at)
        if now is None:
            continue
        solved[place] = now
        least[place] = now[1] @ now[1] / 2
    unscaled = tuple(search.unscaled(k, axis) for k, axis in zip(search.fixed, axes, strict=True))
    estimates = tuple(float(found.estimates[k]) for k in search.fixed)
    return MisfitProfile(names, unscaled, least - search.least, search.level(len(names)), estimates, search.evaluations)


def _is_farthest(place: tuple[int, ...], middle: tuple[int, ...], k: int) -> int:
    """1 for the axis along which a place is farther from the middle than along the others, else 0."""
    distances = [abs(i - m) for i, m in zip(place, middle, strict=True)]
    return int(k == int(np.argmax(distances)) and distances[k] > 0)


class _Search:
    """The misfit over logarithms of positive unknowns and the others by their standard errors, some of them fixed."""

    def __init__(self, found: Fit, fixed: list[int]) -> None:
        try:
            from scipy import optimize, stats
        except ImportError as error:
            raise ImportError("profiles along unknowns need scipy: pip install scipy") from error
        self._optimize, self._stats = optimize, stats
        self._misfit = found.problem.misfit
        self.fixed, self.evaluations = fixed, 0
        p = np.asarray(found.estimates, dtype=float)
        self._free = [i for i in range(len(p)) if i not in fixed]
        self._is_log = self._misfit.lower > 0
        lower, upper = self._misfit.bounds
        self._unit = np.where(self._is_log, 1.0, np.maximum(np.abs(p), np.where(np.isfinite(upper - lower), upper - lower, 1.0)))
        self.estimate = self._scaled(p)
        self._low, self._high = self._scaled(lower), self._scaled(upper)
        residuals, jacobian = self._at(self.estimate)
        self.start = (self.estimate, residuals, jacobian)
        self.least = float(residuals @ residuals / 2)
        self._freedom = len(residuals) - len(p)
        self._has_sigma = bool(np.all(found.problem.observations.sigma > 0))

    def _scaled(self, p: FloatArray) -> FloatArray:
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self._is_log, np.log(np.maximum(p, np.finfo(float).tiny)), p / self._unit)

    def unscaled(self, k: int, x: FloatArray) -> FloatArray:
        values: FloatArray = np.exp(x) if self._is_log[k] else x * self._unit[k]
        return values

    def _p(self, x: FloatArray) -> FloatArray:
        return np.where(self._is_log, np.exp(np.where(self._is_log, x, 0.0)), x * self._unit)

    def _at(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        p = self._p(x)
        self.evaluations += 1
        return self._misfit.residuals(p), self._misfit.jacobian(p) * np.where(self._is_log, p, self._unit)

    def level(self, n: int) -> float:
        """Of the likelihood ratio; with a sigma of the residuals that of Fisher."""
        if self._has_sigma:
            return float(self._stats.chi2.ppf(_SHARE, n) / 2)
        return float(self.least * n * self._stats.f.ppf(_SHARE, n, self._freedom) / self._freedom)

    def axis(self, i: int, points: int, reach: float) -> FloatArray:
        """Evenly around the estimate, so many standard errors of the linear model either way, within the bounds."""
        k = self.fixed[i]
        jacobian = self.start[2]
        scale = 1.0 if self._has_sigma else 2 * self.least / max(1, self._freedom)
        error = float(np.sqrt(scale * np.linalg.pinv(jacobian.T @ jacobian)[k, k]))
        x: FloatArray = self.estimate[k] + error * reach * np.linspace(-1, 1, points)
        return np.unique(np.clip(x, self._low[k], self._high[k]))

    def run(
        self, values: FloatArray, near: tuple[FloatArray, FloatArray, FloatArray]
    ) -> tuple[FloatArray, FloatArray, FloatArray] | None:
        """Place, residuals and Jacobian where the misfit is least with these values, searched from another such place."""
        x, r, J = near
        step = np.zeros_like(x)
        step[self.fixed] = values - x[self.fixed]
        if self._free:  # as the linear model says
            step[self._free] = np.linalg.lstsq(J[:, self._free], -(r + J[:, self.fixed] @ step[self.fixed]), rcond=None)[0]
        first = np.clip(x + step, self._low, self._high)
        first[self.fixed] = values
        try:
            if not self._free:
                return first, *self._at(first)
            return self._minimise(first)
        except NoResult:
            return None

    def _minimise(self, first: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        free = self._free
        known: dict[str, Any] = {}

        def at(y: FloatArray) -> tuple[FloatArray, FloatArray]:
            if known.get("y") is None or not np.array_equal(known["y"], y):
                x = first.copy()
                x[free] = y
                known.update(y=y.copy(), value=self._at(x))
            value: tuple[FloatArray, FloatArray] = known["value"]
            return value

        low, high = self._low[free], self._high[free]
        inside = np.clip(first[free], np.nextafter(low, np.inf), np.nextafter(high, -np.inf))
        best = self._optimize.least_squares(
            lambda y: at(y)[0],
            inside,
            lambda y: at(y)[1][:, free],
            bounds=(low, high),
            x_scale="jac",
            xtol=1e-9,
            ftol=1e-9,
            max_nfev=_MOST_EVALUATIONS,
        )
        if best.status <= 0:
            raise NoResult(best.message)
        x = first.copy()
        x[free] = best.x
        return x, *at(best.x)
