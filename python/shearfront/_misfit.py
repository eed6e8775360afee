# SPDX-License-Identifier: BSD-3-Clause
"""The misfit of a fit as a function, for searches and samplers of others."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import flat
from ._errors import NoResult
from ._examples import with_examples

if TYPE_CHECKING:
    from ._arrays import FloatArray
    from ._fit import Problem


@with_examples
class Misfit:
    """The misfit of a fit as a function of its unknowns, F(p) = sum rho(r_i(p)^2) / 2.

    Residuals are in units of sigma where the data give it. All observations count, those near a shock as well, which a
    fit of points leaves out at last.

    Attributes
    ----------
    names : list of str
        The unknowns, in the order of p.
    start, lower, upper : ndarray
        Start values and bounds.

    Examples
    --------
    With scipy:

    >>> import shearfront as sf
    >>> from scipy.optimize import least_squares
    >>> truth = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = truth.observe([0.2, 0.5, 1], [0.1, 0.3, 0.5, 0.7, 0.9], quantity="cumulative")
    >>> misfit = sf.problem(truth, seen, ["shear_rate.values"], start=[1, 1]).misfit
    >>> found = least_squares(misfit.residuals, misfit.start, misfit.jacobian, bounds=misfit.bounds)
    >>> found.x.round(6)
    array([2.4 , 0.31])
    """

    __slots__ = ("_engine", "_problem", "lower", "names", "start", "upper")

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._engine = _core.Misfit(problem._engine)
        self.names = self._engine.names
        self.start = self._engine.start
        self.lower = self._engine.lower
        self.upper = self._engine.upper

    def __reduce__(self) -> tuple[Any, ...]:
        return Misfit, (self._problem,)

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper bounds, as ``scipy.optimize.least_squares`` takes them."""
        return self.lower, self.upper

    def __call__(self, p: Any) -> float:
        """F(p); infinity where the model has no solution."""
        try:
            return self._engine.misfit(flat(p))
        except NoResult:
            return np.inf

    def residuals(self, p: Any) -> FloatArray:
        """r(p), one per row of the misfit.

        Parameters
        ----------
        p : array_like
            One number per unknown, in the units of the entries.

        Returns
        -------
        ndarray
            Shape (rows,), in units of sigma where the data give it.

        Raises
        ------
        NoResult
            Where the model has no solution.

        Examples
        --------
        >>> sf.problem(scene, seen, "shear_rate.values").misfit.residuals([2.4, 0.31]).shape
        (12,)
        """
        return self._engine.residuals(flat(p))

    def jacobian(self, p: Any) -> FloatArray:
        """dr/dp, shape (rows, unknowns): exact where the method has derivatives, otherwise by differences.

        Parameters
        ----------
        p : array_like
            One number per unknown.

        Returns
        -------
        ndarray
            Shape (rows, unknowns).

        Examples
        --------
        >>> sf.problem(scene, seen, "shear_rate.values").misfit.jacobian([2.4, 0.31]).shape
        (12, 2)
        """
        return self._engine.jacobian(flat(p))

    def log_likelihood(self, p: Any) -> float:
        """-F(p) inside the bounds, -infinity outside: for samplers, with data that have their sigma.

        Examples
        --------
        >>> import shearfront as sf
        >>> bed = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
        >>> seen = bed.observe([0.2], [0.4, 0.5, 0.6], quantity="cumulative", noise=0.01)
        >>> misfit = sf.problem(bed, seen, "shear_rate.values").misfit
        >>> misfit.log_likelihood([-1.0])
        -inf

        Parameters
        ----------
        p : array_like
            One number per unknown.

        Returns
        -------
        float
        """
        values = flat(p)
        if not (np.all(values >= self.lower) and np.all(values <= self.upper)):
            return -np.inf
        return -self(values)
