# SPDX-License-Identifier: BSD-3-Clause
"""What a fit found, and what it says about numbers that were not measured."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import flat, pandas
from ._errors import NoResult
from ._examples import with_examples
from ._scene import Scene

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes

    from ._arrays import FloatArray
    from ._fit import Problem
    from ._posterior import Posterior
    from ._priors import Prior
    from ._profile import MisfitProfile

_DRAWS = 1000


@dataclass(frozen=True)
class Parameter:
    """What was found about one unknown. Error bars are None where they would be invented.

    Attributes
    ----------
    name : str
    start, estimate : float
    std_error : float or None
    ci95, profile95, bootstrap95 : pair of float or None
        95 % intervals: from the curvature, by profile likelihood (on request, beside a parameter at a bound, and with exact
        derivatives where ``ci95`` is doubtful), by bootstrap. An end that the data do not give is NaN.
    at_bound : bool
    held_by_shape : bool
        Whether the shape asked for binds it to its neighbours.
    ci95_is_doubtful : bool or None
        Whether the misfit rises otherwise than the interval assumes; None where it was not checked.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-4)
    >>> found = sf.fit(scene, seen, "shear_rate.values")
    >>> found.parameters["shear_rate.values[1]"].at_bound
    False
    """

    name: str
    start: float
    estimate: float
    std_error: float | None
    ci95: tuple[float, float] | None
    profile95: tuple[float, float] | None
    bootstrap95: tuple[float, float] | None
    at_bound: bool
    held_by_shape: bool
    ci95_is_doubtful: bool | None


@with_examples
@dataclass(frozen=True)
class Prediction:
    """phi and M of a fitted scene with 95 % bands; NaN where there is no band.

    Attributes
    ----------
    t, z : ndarray
    phi, phi_lower, phi_upper, M, M_lower, M_upper : ndarray
        Of shape (times, heights).

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-4)
    >>> found = sf.fit(scene, seen, "shear_rate.values")
    >>> found.predict([1, 3], [0.2, 0.6]).M_upper.shape
    (2, 2)
    """

    t: FloatArray
    z: FloatArray
    phi: FloatArray
    phi_lower: FloatArray
    phi_upper: FloatArray
    M: FloatArray
    M_lower: FloatArray
    M_upper: FloatArray
    remark: str = field(default="", repr=False)

    def to_dataframe(self) -> Any:
        """A row per time and height, as ``solve`` of a fit file writes it; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Examples
        --------
        >>> list(found.predict([1], [0.2]).to_dataframe().columns)[:5]
        ['t', 'z', 'phi', 'lower', 'upper']
        """
        t, z = np.meshgrid(self.t, self.z, indexing="ij")
        columns = {"t": t, "z": z, "phi": self.phi, "lower": self.phi_lower, "upper": self.phi_upper}
        columns |= {"M": self.M, "M_lower": self.M_lower, "M_upper": self.M_upper}
        return pandas().DataFrame({name: values.ravel() for name, values in columns.items()})


@with_examples
@dataclass(frozen=True)
class RateBand:
    """s a(z) of a fit with its pointwise 95 % band; NaN where an unknown without error bar has a part in it.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-4)
    >>> found = sf.fit(scene, seen, "shear_rate.values")
    >>> found.rate_band().z
    array([0.  , 0.29, 0.29, 1.  ])
    """

    z: FloatArray
    a: FloatArray
    lower: FloatArray
    upper: FloatArray

    def __repr__(self) -> str:
        return f"<RateBand at {self.z.size} heights>"

    def to_dataframe(self) -> Any:
        """A table with a row per height; needs pandas.

        Returns
        -------
        pandas.DataFrame
            Columns z, a, lower, upper.

        Examples
        --------
        >>> found.rate_band().to_dataframe().columns.tolist()
        ['z', 'a', 'lower', 'upper']
        """
        return pandas().DataFrame(vars(self))


@with_examples
@dataclass(frozen=True)
class Bootstrap:
    """A parametric bootstrap.

    Attributes
    ----------
    names : list of str
    estimates : ndarray
        A row per replicate that could be fitted, a column per unknown.
    covariance : ndarray
    intervals : dict
        By name, the percentile 95 % interval, or None.
    failed : int
    warnings : list of str

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-4)
    >>> found = sf.fit(scene, seen, "shear_rate.values")
    >>> found.bootstrap(40).estimates.shape
    (40, 2)
    """

    names: list[str]
    estimates: FloatArray = field(repr=False)
    covariance: FloatArray = field(repr=False)
    intervals: dict[str, tuple[float, float] | None]
    failed: int
    warnings: list[str]

    def to_dataframe(self) -> Any:
        """The estimates as a table; needs pandas.

        Returns
        -------
        pandas.DataFrame
            A column per unknown.

        Examples
        --------
        >>> found.bootstrap(5).to_dataframe().shape
        (5, 2)
        """
        return pandas().DataFrame(self.estimates, columns=self.names)

    def to_arviz(self) -> Any:
        """The estimates as one chain of draws, for the plots of ArviZ; needs arviz.

        Returns
        -------
        arviz.InferenceData or DataTree
        """
        import arviz

        draws = {name: self.estimates[None, :, i] for i, name in enumerate(self.names)}
        try:
            return arviz.from_dict(posterior=draws)
        except TypeError:  # version 1 and later
            return arviz.from_dict({"posterior": draws})


@with_examples
class Fit:
    """What a fit found.

    Attributes
    ----------
    problem : Problem
        What was asked.
    scene : Scene
        The scene with the estimates in place.
    parameters : dict of Parameter
        By name.
    warnings : list of str
        What a reader of the estimates must know.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-4)
    >>> found = sf.fit(scene, seen, "shear_rate.values")
    >>> sorted(found.parameters)
    ['shear_rate.values[0]', 'shear_rate.values[1]']
    """

    __slots__ = ("_engine", "facts", "parameters", "problem", "scene")

    def __init__(self, problem: Problem, core: _core.Fitted) -> None:
        self._engine = core
        self.problem = problem
        self.scene = Scene._of(core.scene)
        self.parameters = {row["name"]: Parameter(**row) for row in core.parameters}
        self.facts = core.facts

    @property
    def names(self) -> list[str]:
        """The unknowns."""
        return list(self.parameters)

    @property
    def estimates(self) -> FloatArray:
        """The estimates, in the order of names."""
        return np.array([p.estimate for p in self.parameters.values()])

    @property
    def std_errors(self) -> FloatArray:
        """Their standard errors; NaN where there is none."""
        return np.array([np.nan if p.std_error is None else p.std_error for p in self.parameters.values()])

    @property
    def correlation(self) -> FloatArray:
        """Of the estimates; NaN for those without error bar."""
        return self._engine.correlation

    @property
    def covariance(self) -> FloatArray:
        """Of the estimates, in the units of the entries."""
        i = np.arange(len(self.names))
        first, second = np.minimum(i[:, None], i), np.maximum(i[:, None], i)  # symmetric to the bit
        return self.correlation * self.std_errors[first] * self.std_errors[second]

    @property
    def warnings(self) -> list[str]:
        """What a reader of the estimates must know."""
        return list(self.facts["warnings"])

    @property
    def misfit(self) -> float:
        """F at the estimate."""
        return float(self.facts["misfit"])

    @property
    def sigma(self) -> float:
        """Noise per observation: estimated from the residuals; 1 if the data have their own."""
        return float(self.facts["sigma"])

    @property
    def predicted(self) -> FloatArray:
        """What the fitted scene has for each observation."""
        return self._engine.predicted

    @property
    def residuals(self) -> FloatArray:
        """Observed less predicted, in the unit of the data."""
        return self.problem.observations.value - self.predicted

    def posterior(self, priors: Mapping[str, Prior] | None = None) -> Posterior:
        """What data and priors together say about the unknowns; see :meth:`Problem.posterior`.

        Parameters
        ----------
        priors : mapping, optional
            By unknown or field.

        Returns
        -------
        Posterior

        Examples
        --------
        >>> import shearfront as sf
        >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
        >>> seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-4)
        >>> found = sf.fit(scene, seen, "shear_rate.values")
        >>> found.posterior({"shear_rate.values": sf.LogNormal(1, 2)}).priors["shear_rate.values[1]"]
        LogNormal(median=1, sigma=2)
        """
        return self.problem.posterior(priors)

    def predict(self, t: Any, z: Any, *, draws: int = _DRAWS, seed: int | None = None) -> Prediction:
        """phi and M with 95 % bands, from the error bars, or from the replicates after a fit with a bootstrap.

        Parameters
        ----------
        t, z : array_like
            Times and heights.
        draws : int, optional
        seed : int, optional
            That of the fit unless given.

        Returns
        -------
        Prediction

        Examples
        --------
        >>> found.predict([1, 3], [0.2, 0.6], draws=100).phi_lower.shape
        (2, 2)
        """
        times, heights = flat(t), flat(z)
        phi, amount, why_none, failed = self._engine.predict(times, heights, draws, seed)
        remark = why_none or (f"{failed} of {draws} drawn scenes have no solution and are left out" if failed else "")
        return Prediction(times, heights, *phi, *amount, remark)

    def predict_events(self, *, draws: int = _DRAWS, seed: int | None = None) -> dict[str, Any]:
        """95 % bands of the event times; an end that is infinite: the event may never come.

        Parameters
        ----------
        draws : int, optional
        seed : int, optional
            That of the fit unless given.

        Returns
        -------
        dict
            "t0", "t1", "t_star": pairs; "interfaces": pairs (first, last) of them; None where there is none.

        Examples
        --------
        >>> low, high = found.predict_events(draws=100)["t_star"]
        >>> low < found.scene.events().t_star < high
        True
        """
        return self._engine.predict_events(draws, seed)

    def rate_band(self) -> RateBand:
        """s a(z) with its pointwise 95 % band, of the bootstrap after a fit with one.

        Returns
        -------
        RateBand

        Examples
        --------
        >>> band = found.rate_band()
        >>> bool((band.lower < band.a).all())
        True
        """
        return RateBand(*self._engine.rate_band())

    def draw(self, n: int, seed: int = 1) -> list[Scene]:
        """Scenes drawn from what the data leave possible.

        Parameters
        ----------
        n : int
        seed : int, optional

        Returns
        -------
        list of Scene

        Raises
        ------
        NoResult
            If an unknown has no error bar.

        Examples
        --------
        >>> len(found.draw(3))
        3
        """
        scenes, why_none = self._engine.draws(n, seed)
        if why_none:
            raise NoResult(why_none)
        return [Scene._of(core) for core in scenes]

    def profile(self) -> dict[str, tuple[float, float] | None]:
        """Profile-likelihood 95 % intervals by name; an end that the data do not give is NaN.

        Runs the fit again, and about ten refits for each unknown.

        Returns
        -------
        dict
            Pairs, or None where neither end is known.

        Examples
        --------
        >>> low, high = found.profile()["shear_rate.values[1]"]
        >>> low < 0.31 < high
        True
        """
        again = self.problem._engine.with_uncertainty(True, 0, 1, 0).run()
        return {row["name"]: row["profile95"] for row in again.parameters}

    def profile_curve(self, name: str, *, points: int = 31, reach: float = 3.0) -> MisfitProfile:
        """The least misfit along one unknown: where its 95 % interval ends, and whether it is a parabola.

        Each value begins from its neighbour towards the estimate, where the linear model leads. Needs scipy.

        Parameters
        ----------
        name : str
            An unknown.
        points : int, optional
            Values.
        reach : float, optional
            How far either way, in standard errors of the linear model and within the bounds; of positive unknowns by their
            logarithm.

        Returns
        -------
        MisfitProfile

        Raises
        ------
        InputError
            For a name that is none, and for a loss that is not squared.

        Examples
        --------
        >>> curve = found.profile_curve("shear_rate.values[1]", points=5)
        >>> bool(abs(curve.increase[2]) < 0.01), bool(curve.increase[0] > curve.level)
        (True, True)
        """
        from ._profile import profile_of

        return profile_of(self, (name,), points, reach)

    def profile_surface(self, name: str, other: str, *, points: int = 21, reach: float = 3.0) -> MisfitProfile:
        """The same along two unknowns: how they make up for each other.

        Parameters
        ----------
        name, other : str
            Two unknowns.
        points : int, optional
            Values of each.
        reach : float, optional
            As of :meth:`profile_curve`.

        Returns
        -------
        MisfitProfile

        Examples
        --------
        >>> found.profile_surface("shear_rate.values[0]", "shear_rate.values[1]", points=3).increase.shape
        (3, 3)
        """
        from ._profile import profile_of

        return profile_of(self, (name, other), points, reach)

    def bootstrap(self, replicates: int = 200, seed: int = 1, threads: int = 0) -> Bootstrap:
        """Parametric bootstrap; the numbers do not depend on the threads (0: all cores).

        Parameters
        ----------
        replicates : int, optional
            At least 40 for intervals.
        seed : int, optional
        threads : int, optional

        Returns
        -------
        Bootstrap

        Examples
        --------
        >>> found.bootstrap(40, seed=1).failed
        0
        """
        intervals, estimates, covariance, failed, warnings = self._engine.bootstrap(replicates, seed, threads)
        by_name = dict(zip(self.names, intervals, strict=True))
        return Bootstrap(self.names, estimates, covariance, by_name, failed, warnings)

    def to_dict(self) -> dict[str, Any]:
        """As ``shearfront fit --json``.

        Returns
        -------
        dict

        Examples
        --------
        >>> found.to_dict()["status"]
        'ok'
        """
        on_request = ("profile95", "bootstrap95")
        rows = [
            {k: list(v) if isinstance(v, tuple) else v for k, v in row.items() if v is not None or k not in on_request}
            for row in self._engine.parameters
        ]
        z, t = self.scene._engine.units if self.scene is not None else ("", "")
        along = "x" if self.scene is not None and any(e.startswith("velocity.") for e in self.scene.entries) else "t"
        return {
            **self.facts,
            **({"units": {"z": z, along: t}} if z or t else {}),
            "parameters": rows,
            "correlation": self.correlation.tolist(),
            "covariance": self.covariance.tolist(),
        }

    def to_dataframe(self) -> Any:
        """A row per unknown; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Examples
        --------
        >>> list(found.to_dataframe().columns)
        ['estimate', 'std_error', 'lower', 'upper', 'start', 'at_bound']
        """
        rows = []
        for p in self.parameters.values():
            low, high = p.ci95 or (np.nan, np.nan)
            rows.append((p.estimate, p.std_error, low, high, p.start, p.at_bound))
        columns = ["estimate", "std_error", "lower", "upper", "start", "at_bound"]
        return pandas().DataFrame(rows, index=self.names, columns=columns)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws data and fit; see :func:`shearfront.pictures.fit`.

        Parameters
        ----------
        ax : Axes, optional

        Returns
        -------
        Axes

        Examples
        --------
        >>> found.plot().get_xlabel()
        'M'
        """
        from . import pictures

        return pictures.fit(self, ax=ax)

    def __reduce__(self) -> tuple[Any, ...]:
        return _fit_of, (self.problem, *self._engine.state)

    def __repr__(self) -> str:
        lines = [
            f"{self.problem.name}: {self.facts['observations']} observations ({self.facts['quantity']}), misfit {self.misfit:.6g}"
        ]
        for p in self.parameters.values():
            error = "" if p.std_error is None else f" +- {p.std_error:.2g}"
            lines.append(f"  {p.name} = {p.estimate:.6g}{error}")
        lines += [f"  warning: {w}" for w in self.warnings]
        return "\n".join(lines)


def _fit_of(problem: Problem, scene: str, estimate: list[Any]) -> Fit:
    return Fit(problem, _core.fitted_of_state(problem._engine, scene, estimate))
