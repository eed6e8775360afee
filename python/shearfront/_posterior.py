# SPDX-License-Identifier: BSD-3-Clause
"""What data and priors together say about the unknowns of a fit: its posterior, and samples of it."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import flat
from ._errors import InputError, NoResult
from ._examples import with_examples
from ._misfit import Misfit
from ._priors import HalfNormal, LogNormal, Normal, Prior, Uniform
from ._unbounded import Unbounded

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
        self._misfit = Misfit(problem)
        self.names = list(self._misfit.names)
        self.priors = _resolved(_of_file(problem) | dict(priors or {}), self.names)
        lower = np.maximum(self._misfit.lower, [self.priors[n].low for n in self.names])
        upper = np.minimum(self._misfit.upper, [self.priors[n].high for n in self.names])
        # A density that ends at 0 has no finite logarithm there.
        lower = np.where(lower == 0.0, np.finfo(float).tiny, lower)
        if not np.all(lower < upper):
            name = self.names[int(np.argmin(upper - lower))]
            raise _refused("prior", name, "must leave room between the bounds of the unknown")
        self._unbounded = Unbounded(self.names, lower, upper, self._misfit._engine.shape)
        self._has_sigma = bool(np.all(self._problem.observations.sigma > 0))

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
        values = flat(p)
        if not self._inside(values):
            return -math.inf
        try:
            residuals = self._misfit.residuals(values)
        except NoResult:
            return -math.inf
        return self._likelihood(float(residuals @ residuals)) + sum(
            self.priors[name].log_density(float(x))[0] for name, x in zip(self.names, values, strict=True)
        )

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
            Where there is no solution.

        Examples
        --------
        >>> posterior.gradient([2.5, 0.31]).shape
        (2,)
        """
        return self._with_gradient(self._misfit, flat(p))[1]

    def unbounded(self, x: Any, misfit: Misfit | None = None) -> tuple[float, FloatArray]:
        """log density of the unbounded coordinates x, log |det dp/dx| included, and its gradient in x.

        Parameters
        ----------
        x : array_like
            One number per unknown; :meth:`coordinates` has them for unknowns, :meth:`values` goes back.
        misfit : Misfit, optional
            Its own for each thread.

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
        x = flat(x)
        at = self._unbounded.at(x)
        if at is None:
            return -math.inf, np.zeros_like(x)
        try:
            value, gradient = self._with_gradient(misfit or self._misfit, at.p)
        except NoResult:
            return -math.inf, np.zeros_like(x)
        return value + at.log_volume, at.derivative.T @ gradient + at.slope

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
        at = self._unbounded.at(flat(x))
        if at is None:
            raise NoResult("no room between the bounds at these coordinates")
        return at.p

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
        return self._unbounded.coordinates(flat(p))

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
            raise _refused("sampler", sampler, 'must be "nutpie" or "emcee"')
        if sampler == "nutpie" and self._has_steps():
            raise _refused("sampler", sampler, 'must be "emcee": points next to shocks make steps, which have no gradient')
        start = self._start()
        run = _nutpie if sampler == "nutpie" else _emcee
        x = run(self, start, draws, chains, tune, seed, cores or os.cpu_count() or 1, progress)
        return self._inference_data(x, seed)

    def _has_steps(self) -> bool:
        diffusion = self._problem.scene.entries.get("diffusion.D", 0.0)
        return self._problem.observations.quantity == "point" and not diffusion > 0

    def _inside(self, p: FloatArray) -> bool:
        x = self._unbounded
        return all(low <= value <= high for value, (low, high, *_) in ((p[i], x._ends(i, p)) for i in range(len(self.names))))

    def _likelihood(self, squares: float) -> float:
        if self._has_sigma:
            return -squares / 2
        return -self._misfit._engine.n_rows / 2 * math.log(squares)

    def _with_gradient(self, misfit: Misfit, p: FloatArray) -> tuple[float, FloatArray]:
        squares, gradient = misfit._engine.squares(p)
        value = self._likelihood(squares)
        slopes = gradient * (-0.5 if self._has_sigma else -misfit._engine.n_rows / 2 / squares)
        for i, name in enumerate(self.names):
            density, slope = self.priors[name].log_density(float(p[i]))
            value += density
            slopes[i] += slope
        return value, slopes

    def _start(self) -> tuple[FloatArray, FloatArray]:
        """The estimate of the fit in coordinates, and a matrix that makes the posterior there about round."""
        x = self.coordinates(self._problem.run().estimates)
        at = self._unbounded.at(x)
        assert at is not None
        jacobian = self._misfit.jacobian(at.p) @ at.derivative
        residuals = self._misfit.residuals(at.p)
        scale = 1.0 if self._has_sigma else math.sqrt(len(residuals) / float(residuals @ residuals))
        curvature = (scale * jacobian).T @ (scale * jacobian) + np.eye(len(x)) / _WIDEST**2
        return x, np.linalg.inv(np.linalg.cholesky(curvature)).T

    def _inference_data(self, x: FloatArray, seed: int) -> Any:
        import arviz

        chains, draws, n = x.shape
        p = np.array([[self.values(x[c, d]) for d in range(draws)] for c in range(chains)]).reshape(chains, draws, n)
        fields: dict[str, list[int]] = {}
        for i, name in enumerate(self.names):
            fields.setdefault(name.split("[")[0], []).append(i)
        posterior = {f: p[:, :, places] if "[" in self.names[places[0]] else p[:, :, places[0]] for f, places in fields.items()}
        residuals = np.array([[self._misfit.residuals(p[c, d]) for d in range(draws)] for c in range(chains)])
        sigma = np.ones((chains, draws))
        if not self._has_sigma:
            random = np.random.default_rng(seed)
            sigma = np.sqrt((residuals**2).sum(axis=2) / random.chisquare(residuals.shape[2], (chains, draws)))
            posterior["sigma"] = sigma
        scaled = residuals / sigma[:, :, None]
        likelihood = {"residuals": -(scaled**2) / 2 - np.log(sigma[:, :, None] * math.sqrt(2 * math.pi))}
        try:
            return arviz.from_dict(posterior=posterior, log_likelihood=likelihood)
        except TypeError:  # version 1 and later
            return arviz.from_dict({"posterior": posterior, "log_likelihood": likelihood})


def _of_file(problem: Problem) -> dict[str, Prior]:
    """Those of [prior] in a fit file."""
    kinds: dict[str, Callable[[float, float], Prior]] = {
        "uniform": Uniform,
        "normal": Normal,
        "lognormal": LogNormal,
        "half_normal": lambda std, _: HalfNormal(std),
    }
    return {name: kinds[kind](first, second) for name, kind, first, second in problem._engine.priors}


def _refused(key: str, value: str, constraint: str) -> InputError:
    text = f"{key} = {value}; {constraint}"
    return InputError(text, [(key, value, constraint, text)])


def _resolved(priors: Mapping[str, Prior], names: list[str]) -> dict[str, Prior]:
    """By unknown; a field stands for all of its entries."""
    found: dict[str, Prior] = {}
    for key, prior in priors.items():
        matching = [n for n in names if n == key or n.startswith(key + "[")]
        if not matching:
            raise _refused("prior", key, f"must be an unknown of the fit: {', '.join(names)}")
        found |= dict.fromkeys(matching, prior)
    return {name: found.get(name, Uniform()) for name in names}


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
        misfit = Misfit(posterior._problem)  # for this chain alone

        def logp(y: FloatArray) -> tuple[float, FloatArray]:
            value, gradient = posterior.unbounded(x0 + root @ y, misfit)
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
        at = posterior._unbounded.at(flat(x))
        return -math.inf if at is None else posterior.log_density(at.p) + at.log_volume

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
