# SPDX-License-Identifier: BSD-3-Clause
"""What data and priors together say about the unknowns of a fit: its posterior, and samples of it."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import flat
from ._errors import one_complaint
from ._examples import with_examples
from ._priors import KINDS, Prior, Uniform

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from ._arrays import FloatArray
    from ._fit import Problem

#: Of the curvature at the start, what is added so that it can be inverted: of a prior as wide as this in the coordinates.
_WIDEST = 30.0


@with_examples
class Posterior:
    """log posterior density of the unknowns of a fit, and samples of it.

    Data with sigma: Gaussian, -sum r^2 / 2. Without: sigma is unknown with density 1 / sigma and integrated out, which leaves
    -n / 2 log sum r^2 of n residuals; draws of it come with the samples. The loss of the fit plays no part. Correlated noise
    of the fit whitens r, with the lengths as the fit found them.

    Attributes
    ----------
    names : list of str
        The unknowns.
    priors : dict
        By name: those given, those of [prior] in the fit file, flat within the bounds of the fit where there is none.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-3)
    >>> posterior = sf.problem(scene, seen, "shear_rate.values").posterior({"shear_rate.values[1]": sf.Normal(0.3, 0.05)})
    >>> posterior.log_density([2.4, 0.31]) > posterior.log_density([2.5, 0.31])
    True
    """

    def __init__(self, problem: Problem, priors: Mapping[str, Prior] | None = None) -> None:
        if problem._engine.has_noise_model:
            problem = type(problem)(problem._engine.with_noise_of(problem.run()._engine))
        self._problem = problem
        self.priors = priors_of(problem, priors)
        self._engine = self._made()
        self.names = self._engine.names

    def _made(self) -> _core.Posterior:
        """One that nothing else uses."""
        return _core.Posterior(self._problem._engine, [(name, *prior._given()) for name, prior in self.priors.items()])

    def __reduce__(self) -> tuple[Any, ...]:
        return Posterior, (self._problem, self.priors)

    def log_density(self, p: Any) -> float:
        """log density of the unknowns p up to a constant; -infinity outside the bounds and where there is no solution.

        Parameters
        ----------
        p : array_like
            One number per unknown, in the units of the entries.

        Returns
        -------
        float

        Examples
        --------
        >>> posterior.log_density([2.4, 0.31]) > posterior.log_density([2.5, 0.31])
        True
        """
        return self._engine.log_density(flat(p))

    def gradient(self, p: Any) -> FloatArray:
        """Of log_density in the unknowns, exact where the method has derivatives.

        Parameters
        ----------
        p : array_like
            One number per unknown.

        Returns
        -------
        ndarray
            Shape (unknowns,).

        Raises
        ------
        NoResult
            Where there is no solution, and outside the bounds.

        Examples
        --------
        >>> posterior.gradient([2.5, 0.31]).shape
        (2,)
        """
        return self._engine.gradient(flat(p))

    def unbounded(self, x: Any) -> tuple[float, FloatArray]:
        """log density of the unbounded coordinates x, log |det dp/dx| included, and its gradient in x.

        Parameters
        ----------
        x : array_like
            One number per unknown; :meth:`coordinates` has them for unknowns, :meth:`values` goes back.

        Returns
        -------
        float, ndarray
            -infinity and zeros where there is no solution.

        Examples
        --------
        >>> value, gradient = posterior.unbounded(posterior.coordinates([2.4, 0.31]))
        >>> gradient.shape
        (2,)
        """
        return self._engine.unbounded(flat(x))

    def values(self, x: Any) -> FloatArray:
        """The unknowns at the unbounded coordinates x.

        Parameters
        ----------
        x : array_like
            One number per unknown.

        Returns
        -------
        ndarray

        Examples
        --------
        >>> posterior.values(posterior.coordinates([2.4, 0.31])).round(9)
        array([2.4 , 0.31])
        """
        return self._engine.values(flat(x))

    def coordinates(self, p: Any) -> FloatArray:
        """The unbounded coordinates of the unknowns p.

        Parameters
        ----------
        p : array_like
            One number per unknown; at a bound they are moved inside by a millionth of the way.

        Returns
        -------
        ndarray

        Examples
        --------
        >>> bool(posterior.coordinates([2.5, 0.31])[0] > posterior.coordinates([2.4, 0.31])[0])
        True
        """
        return self._engine.coordinates(flat(p))

    def sample(
        self,
        draws: int = 1000,
        chains: int = 4,
        tune: int = 400,
        *,
        seed: int = 1,
        sampler: str = "nutpie",
        cores: int | None = None,
        progress: bool = False,
    ) -> Any:
        """Draws of the posterior, by NUTS with exact gradients (nutpie), or by an ensemble without (emcee).

        Parameters
        ----------
        draws, chains, tune : int, optional
            Of each chain; those of emcee are of all its walkers together.
        seed : int, optional
        sampler : "nutpie" or "emcee", optional
        cores : int, optional
        progress : bool, optional

        Returns
        -------
        arviz.InferenceData
            Groups posterior (a variable per field of the scene, and sigma where it was not given) and log_likelihood (a
            column per residual).

        Raises
        ------
        InputError
            If the sampler needs a gradient and the misfit has steps: points without diffusion.

        Examples
        --------
        >>> samples = posterior.sample(100, chains=1, tune=100)
        >>> samples.posterior["shear_rate.values"].shape
        (1, 100, 2)
        """
        if sampler not in ("nutpie", "emcee"):
            raise one_complaint("sampler", sampler, 'must be "nutpie" or "emcee"')
        if sampler == "nutpie" and self._engine.has_steps:
            raise one_complaint("sampler", sampler, 'must be "emcee": points next to shocks make steps, which have no gradient')
        start = self._start()
        run = _nutpie if sampler == "nutpie" else _emcee
        x = run(self, start, draws, chains, tune, seed, cores or os.cpu_count() or 1, progress)
        return self._inference_data(x, seed)

    def _start(self) -> tuple[FloatArray, FloatArray]:
        """The estimate of the fit in coordinates, and a matrix that makes the posterior there about round."""
        x = self.coordinates(self._problem.run().estimates)
        curvature = self._engine.curvature(x) + np.eye(len(x)) / _WIDEST**2
        return x, np.linalg.inv(np.linalg.cholesky(curvature)).T

    def _inference_data(self, x: FloatArray, seed: int) -> Any:
        import arviz

        chains, draws, n = x.shape
        p = np.array([[self.values(x[c, d]) for d in range(draws)] for c in range(chains)]).reshape(chains, draws, n)
        fields: dict[str, list[int]] = {}
        for i, name in enumerate(self.names):
            fields.setdefault(name.split("[")[0], []).append(i)
        posterior = {f: p[:, :, places] if "[" in self.names[places[0]] else p[:, :, places[0]] for f, places in fields.items()}
        misfit = self._problem.misfit
        residuals = np.array([[misfit.residuals(p[c, d]) for d in range(draws)] for c in range(chains)])
        sigma = np.ones((chains, draws))
        if not self._engine.sigma_is_given:
            random = np.random.default_rng(seed)
            sigma = np.sqrt((residuals**2).sum(axis=2) / random.chisquare(residuals.shape[2], (chains, draws)))
            posterior["sigma"] = sigma
        scaled = residuals / sigma[:, :, None]
        likelihood = {"residuals": -(scaled**2) / 2 - np.log(sigma[:, :, None] * math.sqrt(2 * math.pi))}
        try:
            return arviz.from_dict(posterior=posterior, log_likelihood=likelihood)
        except TypeError:  # version 1 and later
            return arviz.from_dict({"posterior": posterior, "log_likelihood": likelihood})


def priors_of(problem: Problem, given: Mapping[str, Prior] | None) -> dict[str, Prior]:
    """By unknown, flat where there is none: those of [prior] in a fit file, and in their place these."""
    of_file = {name: KINDS[kind](first, second) for name, kind, first, second in problem._engine.priors}
    priors = of_file | dict(given or {})
    places = problem._engine.last_named_by(list(priors))
    return {name: Uniform() if k is None else list(priors.values())[k] for name, k in places.items()}


def _nutpie(
    posterior: Posterior,
    start: tuple[FloatArray, FloatArray],
    draws: int,
    chains: int,
    tune: int,
    seed: int,
    cores: int,
    progress: bool,
) -> FloatArray:
    """NUTS over y, x = x0 + L y."""
    import nutpie
    from nutpie.compiled_pyfunc import from_pyfunc

    x0, root = start
    n = len(x0)

    def make_logp() -> Callable[[FloatArray], tuple[float, FloatArray]]:
        engine = posterior._made()  # for this chain alone

        def logp(y: FloatArray) -> tuple[float, FloatArray]:
            value, gradient = engine.unbounded(x0 + root @ y)
            if not math.isfinite(value):
                raise _NoDensity
            return value, root.T @ gradient

        return logp

    def make_expand(*_: Any) -> Callable[[FloatArray], dict[str, FloatArray]]:
        return lambda y: {"x": x0 + root @ y}

    model = from_pyfunc(
        n,
        make_logp,
        make_expand,
        [np.dtype(np.float64)],
        [(n,)],
        ["x"],
        make_initial_point_fn=lambda s: np.random.default_rng(s).normal(size=n),
    )
    trace = nutpie.sample(
        model,
        draws=draws,
        tune=tune,
        chains=chains,
        cores=min(cores, chains),
        seed=seed,
        save_warmup=False,
        progress_bar=progress,
    )
    return np.asarray(trace.posterior["x"].values)


class _NoDensity(ValueError):
    """Where the density is 0: nutpie takes it as a divergence."""

    is_recoverable = True


def _emcee(
    posterior: Posterior,
    start: tuple[FloatArray, FloatArray],
    draws: int,
    chains: int,
    tune: int,
    seed: int,
    cores: int,
    progress: bool,
) -> FloatArray:
    """An affine invariant ensemble over x; a chain for each of `chains` groups of walkers."""
    import emcee

    x0, root = start
    n = len(x0)
    n_walkers = max(2 * n + 2, 8) // chains * chains + chains

    def log_density(x: FloatArray) -> float:
        return posterior._engine.log_density_of(flat(x))

    random = np.random.default_rng(seed)
    ensemble = emcee.EnsembleSampler(n_walkers, n, log_density)
    ensemble._random.seed(seed)
    first = x0 + random.normal(size=(n_walkers, n)) @ root.T
    per_walker = -(-draws * chains // n_walkers)
    ensemble.run_mcmc(first, tune, progress=progress)
    ensemble.reset()
    ensemble.run_mcmc(None, per_walker, progress=progress)
    x = ensemble.get_chain()  # (steps, walkers, n)
    groups = x.transpose(1, 0, 2).reshape(chains, -1, n)
    return np.asarray(groups[:, :draws])
