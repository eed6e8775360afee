# SPDX-License-Identifier: BSD-3-Clause
"""A shear rate that is as smooth as the data let it be."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import NoResult, one_complaint
from ._estimate import RateBand
from ._examples import with_examples
from ._misfit import Misfit

if TYPE_CHECKING:
    from ._arrays import FloatArray
    from ._fit import Problem
    from ._scene import Scene

#: Half the width of a 95 % band in standard errors.
_WIDTH = 1.959963984540054
#: Weights that are tried, in powers of ten of the one at which data and smoothness say as much about a(z).
_DECADES = np.arange(4.0, -6.5, -1.0)


@with_examples
@dataclass(frozen=True, repr=False)
class SmoothFit:
    """A table of a(z) found under a prior of smoothness whose weight the data have chosen; made by :meth:`Problem.smooth`.

    Attributes
    ----------
    names : list of str
        All unknowns of the fit.
    estimates, covariance : ndarray
        The most probable values and their covariance, that of a Gaussian at the peak.
    weight : float
        w of the prior: larger is smoother.
    effective : float
        Numbers that the data determine of the table: from 2, an exponential, to all of its points.
    log_evidence : float
        log of the probability of the data with this weight, up to a constant.
    misfit : float
        Half the sum of squares of the residuals.
    scene : Scene
        With the estimates.

    Examples
    --------
    >>> import numpy as np
    >>> import shearfront as sf
    >>> z = np.linspace(0, 1, 11)
    >>> scene = sf.Scene(shear_rate=sf.Table(z, 4 * np.exp(-3 * z)), initial=sf.Step(0.5))
    >>> seen = scene.observe([0.3, 0.6, 1.0], np.linspace(0.05, 0.95, 19), quantity="bin", width=0.05, noise=0.01)
    >>> found = sf.problem(scene, seen, "shear_rate.values").smooth()
    >>> bool(2 <= found.effective < 6), found.rate_band().z.size
    (True, 11)
    """

    names: list[str]
    estimates: FloatArray
    covariance: FloatArray
    weight: float
    effective: float
    log_evidence: float
    misfit: float
    scene: Scene
    _z: FloatArray
    _log_errors: FloatArray

    def __repr__(self) -> str:
        return f"<SmoothFit of {self._z.size} points: {self.effective:.1f} of them determined, misfit {self.misfit:.4g}>"

    @property
    def std_errors(self) -> FloatArray:
        """Of the estimates, prior included."""
        return np.sqrt(np.diag(self.covariance))

    def rate_band(self) -> RateBand:
        """s a(z) at the points of the table with its pointwise 95 % band, from the covariance of log a.

        Returns
        -------
        RateBand

        Examples
        --------
        >>> smooth = sf.problem(scene.with_(shear_rate=sf.Table([0, 0.5, 1], [2, 1, 0.3])), seen, "shear_rate.values").smooth()
        >>> smooth.rate_band().z
        array([0. , 0.5, 1. ])
        """
        a = self.scene.entries["shear_rate.scale"] * self.scene.shear_rate(self._z)
        spread = np.exp(_WIDTH * self._log_errors)
        return RateBand(self._z, a, a / spread, a * spread)


def smooth_fit(problem: Problem, weight: float | None) -> SmoothFit:
    """:meth:`Problem.smooth`."""
    try:
        from scipy import optimize
    except ImportError as error:
        raise ImportError("smooth shear rates need scipy: pip install scipy") from error
    if problem._engine.has_noise_model:
        problem = type(problem)(problem._engine.with_noise_of(problem.run()._engine))
    search = _Search(problem, optimize)
    if weight is not None:
        if not (math.isfinite(weight) and weight > 0):
            raise one_complaint("weight", str(weight), "must be finite and > 0")
        return search.result(weight, search.solved(weight, search.start))
    # From the stiffest on, each from where the last one ended: the first is all but an exponential and has no other valley.
    x, best = search.start, None
    for decade in _DECADES:
        w = search.balance * 10.0**decade
        x = search.solved(w, x)
        value = search.log_evidence(w, x)
        if best is None or value > best[0]:
            best = (value, decade, x)
    assert best is not None
    at = best[2]

    def loss(decade: float) -> float:
        w = search.balance * 10.0**decade
        return -search.log_evidence(w, search.solved(w, at))

    found = optimize.minimize_scalar(loss, bounds=(best[1] - 1, best[1] + 1), method="bounded", options={"xatol": 0.02})
    decade = float(found.x) if -found.fun > best[0] else float(best[1])
    w = search.balance * 10.0**decade
    return search.result(w, search.solved(w, at))


class _Search:
    """The most probable unknowns of a weight, in coordinates x: log a at the points of the table, the others as they are."""

    def __init__(self, problem: Problem, optimize: Any) -> None:
        self._problem = problem
        self._least_squares = optimize.least_squares
        self._misfit = Misfit(problem)
        names = self._misfit.names
        index = [re.fullmatch(r"shear_rate\.values\[(\d+)\]", name) for name in names]
        entries = problem.scene.entries
        self._z = np.array([at for key, at in entries.items() if key.startswith("shear_rate.z[")])
        self._points = [i for i, at in enumerate(index) if at]
        if len(self._points) != self._z.size or self._z.size < 3:
            raise one_complaint("unknown", ", ".join(names), "must have all values of a table of at least 3 points")
        if np.any(np.diff(self._z) <= 0):
            raise one_complaint("shear_rate.z", str(self._z.tolist()), "must ascend: a table that jumps is not smooth")
        if not np.all(self._misfit.start[self._points] > 0):
            raise one_complaint("shear_rate.values", None, "must be > 0 to be smooth in their logarithm")
        self.start = self._x(self._misfit.start)
        self._n_rows = self._misfit.residuals(self._misfit.start).size
        self._has_sigma = bool(np.all(problem.observations.sigma > 0))
        self._bends = self._second_differences()
        jacobian = self._misfit.jacobian(self._misfit.start) * self._slopes(self.start)
        self.balance = float(np.sum(jacobian[:, self._points] ** 2) / np.sum(self._bends**2))

    def _second_differences(self) -> FloatArray:
        """Rows whose squares sum to int (d^2 log a / dx^2)^2 dx, x the height over that of the table: 0 of an exponential."""
        z = (self._z - self._z[0]) / (self._z[-1] - self._z[0])
        h = np.diff(z)
        rows = np.zeros((z.size - 2, self._misfit.start.size))
        for k in range(z.size - 2):
            width = math.sqrt((h[k] + h[k + 1]) / 2)
            at = self._points[k : k + 3]
            rows[k, at] = np.array([1 / h[k], -1 / h[k] - 1 / h[k + 1], 1 / h[k + 1]]) / width
        return rows

    def _x(self, p: FloatArray) -> FloatArray:
        x: FloatArray = p.copy()
        x[self._points] = np.log(x[self._points])
        return x

    def _p(self, x: FloatArray) -> FloatArray:
        p: FloatArray = x.copy()
        p[self._points] = np.exp(p[self._points])
        return p

    def _slopes(self, x: FloatArray) -> FloatArray:
        """dp / dx."""
        slopes: FloatArray = np.ones_like(x)
        slopes[self._points] = np.exp(x[self._points])
        return slopes

    def _bounds(self) -> tuple[FloatArray, FloatArray]:
        lower, upper = self._misfit.lower.copy(), self._misfit.upper.copy()
        with np.errstate(divide="ignore"):
            lower[self._points] = np.log(np.maximum(lower[self._points], 0))
        upper[self._points] = np.log(upper[self._points])
        return lower, upper

    def solved(self, weight: float, x: FloatArray) -> FloatArray:
        root = math.sqrt(weight)

        def residuals(y: FloatArray) -> FloatArray:
            return np.concatenate([self._misfit.residuals(self._p(y)), root * (self._bends @ y)])

        def jacobian(y: FloatArray) -> FloatArray:
            return np.vstack([self._misfit.jacobian(self._p(y)) * self._slopes(y), root * self._bends])

        found = self._least_squares(residuals, x, jacobian, bounds=self._bounds(), x_scale="jac", xtol=1e-10, ftol=1e-10)
        if not np.all(np.isfinite(found.x)):
            raise NoResult("no smooth a(z) was found")
        return np.asarray(found.x)

    def _at(self, weight: float, x: FloatArray) -> tuple[float, float, FloatArray, FloatArray]:
        """Sum of squares, the same with the penalty, J^T J, and that with the penalty's."""
        p = self._p(x)
        r = self._misfit.residuals(p)
        jacobian = self._misfit.jacobian(p) * self._slopes(x)
        bends = self._bends @ x
        squares = float(r @ r)
        plain = jacobian.T @ jacobian
        return squares, squares + weight * float(bends @ bends), plain, plain + weight * self._bends.T @ self._bends

    def log_evidence(self, weight: float, x: FloatArray) -> float:
        """By Laplace's method, for flat priors of what the penalty does not see, and of log sigma where that is unknown."""
        _, penalised, _, curvature = self._at(weight, x)
        sign, log_det = np.linalg.slogdet(curvature)
        if not sign > 0:
            return -math.inf
        m = self._bends.shape[0]
        n = self._n_rows
        free = x.size - m
        fit = penalised / 2 if self._has_sigma else (n - free) / 2 * math.log(penalised)
        return float(m / 2 * math.log(weight) - log_det / 2 - fit)

    def result(self, weight: float, x: FloatArray) -> SmoothFit:
        squares, penalised, plain, curvature = self._at(weight, x)
        covariance = np.linalg.inv(curvature)
        effective = float(np.trace(covariance @ plain)) - (x.size - len(self._points))
        if not self._has_sigma:
            covariance *= penalised / (self._n_rows - (x.size - self._bends.shape[0]))
        slopes = self._slopes(x)
        p = self._p(x)
        names = self._misfit.names
        return SmoothFit(
            names=names,
            estimates=p,
            covariance=covariance * np.outer(slopes, slopes),
            weight=weight,
            effective=effective,
            log_evidence=self.log_evidence(weight, x),
            misfit=squares / 2,
            scene=self._problem.scene.with_(dict(zip(names, p.tolist(), strict=True))),
            _z=self._z,
            _log_errors=np.sqrt(np.diag(covariance))[self._points],
        )
