# SPDX-License-Identifier: BSD-3-Clause
"""A fit as models of UM-Bridge, for the many methods that speak its protocol."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._posterior import Posterior

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ._fit import Problem
    from ._priors import Prior

_Lists = list[list[float]]


def umbridge(problem: Problem, priors: Mapping[str, Prior] | None = None) -> list[Any]:
    """Two models of UM-Bridge: ``forward``, unknowns to residuals, and ``posterior``, unknowns to log density.

    Both have one input, the unknowns in the units of their entries, and evaluation, gradient and Jacobian. Needs the package
    umbridge.

    Parameters
    ----------
    problem : Problem
    priors : mapping, optional
        As :meth:`Problem.posterior` takes them.

    Returns
    -------
    list of umbridge.Model
        Served by ``umbridge.serve_models(models, port)``.

    Examples
    --------
    >>> import shearfront as sf
    >>> bed = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
    >>> seen = bed.observe([0.2, 0.4], [0.3, 0.5, 0.7], quantity="cumulative", noise=0.01)
    >>> forward, posterior = sf.umbridge(sf.problem(bed, seen, "shear_rate.values"))
    >>> len(forward([[1.0]])[0])
    6
    """
    import umbridge as bridge

    posterior = Posterior(problem, priors)
    misfit = posterior._problem.misfit
    n, n_rows = len(posterior.names), posterior._engine.n_residuals

    class Differentiable(bridge.Model):  # type: ignore[misc]  # without types
        """One input, one output, with its Jacobian."""

        def __init__(self, name: str, n_out: int) -> None:
            super().__init__(name)
            self._n_out = n_out

        def get_input_sizes(self, config: Any = None) -> list[int]:
            return [n]

        def get_output_sizes(self, config: Any = None) -> list[int]:
            return [self._n_out]

        def value(self, p: Any) -> Any:
            """The output at p."""
            raise NotImplementedError

        def jacobian(self, p: Any) -> Any:
            """Its derivatives, a row per output."""
            raise NotImplementedError

        def __call__(self, parameters: _Lists, config: Any = None) -> _Lists:
            return [np.atleast_1d(self.value(np.array(parameters[0]))).tolist()]

        def gradient(self, out_wrt: int, in_wrt: int, parameters: _Lists, sens: list[float], config: Any = None) -> list[float]:
            return list((self.jacobian(np.array(parameters[0])).T @ np.array(sens)).tolist())

        def apply_jacobian(
            self, out_wrt: int, in_wrt: int, parameters: _Lists, vec: list[float], config: Any = None
        ) -> list[float]:
            return list((self.jacobian(np.array(parameters[0])) @ np.array(vec)).tolist())

        def supports_evaluate(self) -> bool:
            return True

        def supports_gradient(self) -> bool:
            return True

        def supports_apply_jacobian(self) -> bool:
            return True

    class Forward(Differentiable):
        """Residuals, in units of sigma where the data give it."""

        def value(self, p: Any) -> Any:
            return misfit.residuals(p)

        def jacobian(self, p: Any) -> Any:
            return misfit.jacobian(p)

    class LogDensity(Differentiable):
        """log density of the posterior."""

        def value(self, p: Any) -> Any:
            return posterior.log_density(p)

        def jacobian(self, p: Any) -> Any:
            return posterior.gradient(p)[None, :]

    return [Forward("forward", n_rows), LogDensity("posterior", 1)]
