# SPDX-License-Identifier: BSD-3-Clause
"""The inverse problem: entries of a scene from observations."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import flat, pandas
from ._data import Observations, data
from ._errors import InputError, NoResult, without_places
from ._scene import Scene
from ._toml import toml_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._arrays import FloatArray

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
        95 % intervals: from the curvature, by profile likelihood, by bootstrap. An end that the data do not give is NaN.
    at_bound : bool
    ci95_is_doubtful : bool or None
        Whether the misfit rises otherwise than the interval assumes; None where it was not checked.
    """

    name: str
    start: float
    estimate: float
    std_error: float | None
    ci95: tuple[float, float] | None
    profile95: tuple[float, float] | None
    bootstrap95: tuple[float, float] | None
    at_bound: bool
    ci95_is_doubtful: bool | None


@dataclass(frozen=True)
class Prediction:
    """phi and M of a fitted scene with 95 % bands; NaN where there is no band.

    Attributes
    ----------
    t, z : ndarray
    phi, phi_lower, phi_upper, M, M_lower, M_upper : ndarray
        Of shape (times, heights).
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
        """A row per time and height, as ``fit --predict`` writes it; needs pandas."""
        t, z = np.meshgrid(self.t, self.z, indexing="ij")
        columns = {"t": t, "z": z, "phi": self.phi, "lower": self.phi_lower, "upper": self.phi_upper}
        columns |= {"M": self.M, "M_lower": self.M_lower, "M_upper": self.M_upper}
        return pandas().DataFrame({name: values.ravel() for name, values in columns.items()})


@dataclass(frozen=True)
class RateBand:
    """s a(z) of a fit with its pointwise 95 % band; NaN where an unknown without error bar has a part in it."""

    z: FloatArray
    a: FloatArray
    lower: FloatArray
    upper: FloatArray


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
    """

    names: list[str]
    estimates: FloatArray = field(repr=False)
    covariance: FloatArray = field(repr=False)
    intervals: dict[str, tuple[float, float] | None]
    failed: int
    warnings: list[str]

    def to_dataframe(self) -> Any:
        """The estimates as a table; needs pandas."""
        return pandas().DataFrame(self.estimates, columns=self.names)

    def to_arviz(self) -> Any:
        """The estimates as one chain of draws, for the plots of ArviZ; needs arviz."""
        import arviz

        draws = {name: self.estimates[None, :, i] for i, name in enumerate(self.names)}
        try:
            return arviz.from_dict(posterior=draws)
        except TypeError:  # version 1 and later
            return arviz.from_dict({"posterior": draws})


class Problem:
    """A fit that has not run yet: scene, observations, unknowns and settings.

    Its misfit can be handed to searches and samplers of others: ``problem.misfit`` has residuals, Jacobian and a
    log-likelihood. Made by :func:`problem`, or by :func:`read_fit` from a fit file.
    """

    __slots__ = ("_engine", "observations", "scene")
    scene: Scene
    observations: Observations

    def __init__(self, core: _core.FitProblem) -> None:
        self._engine = core
        self.scene = Scene._of(core.scene)
        self.observations = Observations(core.observations)

    @property
    def name(self) -> str:
        """Its name."""
        return self._engine.name

    @property
    def misfit(self) -> Misfit:
        """The misfit as a function of the unknowns."""
        return Misfit(self)

    def run(self) -> Fit:
        """Finds the unknowns.

        Raises
        ------
        NoResult
            If no estimate was found.
        """
        return Fit(self, self._engine.run())

    def with_(self, numbers: Mapping[str, float]) -> Problem:
        """The same fit with other numbers of its scene, by the names of their entries."""
        return Problem(self._engine.with_scene(self.scene.with_(numbers)._engine))

    def __reduce__(self) -> tuple[Any, ...]:
        return _problem_of, (self._engine.state,)

    def __repr__(self) -> str:
        return f"<Problem {self.name!r}: {len(self.observations)} observations>"


def _problem_of(state: Any) -> Problem:
    return Problem(_core.problem_of_state(*state))


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

    __slots__ = ("_engine", "lower", "names", "start", "upper")

    def __init__(self, problem: Problem) -> None:
        self._engine = _core.Misfit(problem._engine)
        self.names = self._engine.names
        self.start = self._engine.start
        self.lower = self._engine.lower
        self.upper = self._engine.upper

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
        """r(p), one per row of the misfit."""
        return self._engine.residuals(flat(p))

    def jacobian(self, p: Any) -> FloatArray:
        """dr/dp, shape (rows, unknowns): exact where the method has derivatives, otherwise by differences."""
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
        """
        values = flat(p)
        if not (np.all(values >= self.lower) and np.all(values <= self.upper)):
            return -np.inf
        return -self(values)


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

    def predict(self, t: Any, z: Any, *, draws: int = _DRAWS, seed: int | None = None) -> Prediction:
        """phi and M with 95 % bands, from scenes drawn from the error bars.

        Parameters
        ----------
        t, z : array_like
            Times and heights.
        draws : int, optional
        seed : int, optional
            That of the fit unless given.
        """
        times, heights = flat(t), flat(z)
        phi, amount, why_none, failed = self._engine.predict(times, heights, draws, seed)
        remark = why_none or (f"{failed} of {draws} drawn scenes have no solution and are left out" if failed else "")
        return Prediction(times, heights, *phi, *amount, remark)

    def predict_events(self, *, draws: int = _DRAWS, seed: int | None = None) -> dict[str, Any]:
        """95 % bands of the event times; an end that is infinite: the event may never come."""
        return self._engine.predict_events(draws, seed)

    def rate_band(self) -> RateBand:
        """s a(z) with its pointwise 95 % band."""
        return RateBand(*self._engine.rate_band())

    def draw(self, n: int, seed: int = 1) -> list[Scene]:
        """Scenes drawn from what the data leave possible."""
        scenes, why_none = self._engine.draws(n, seed)
        if why_none:
            raise NoResult(why_none)
        return [Scene._of(core) for core in scenes]

    def profile(self) -> dict[str, tuple[float, float] | None]:
        """Profile-likelihood 95 % intervals by name; an end that the data do not give is NaN.

        Runs the fit again, and about ten refits for each unknown.
        """
        again = self.problem._engine.with_uncertainty(True, 0, 1, 0).run()
        return {row["name"]: row["profile95"] for row in again.parameters}

    def bootstrap(self, replicates: int = 200, seed: int = 1, threads: int = 0) -> Bootstrap:
        """Parametric bootstrap; the numbers do not depend on the threads (0: all cores)."""
        intervals, estimates, covariance, failed, warnings = self._engine.bootstrap(replicates, seed, threads)
        by_name = dict(zip(self.names, intervals, strict=True))
        return Bootstrap(self.names, estimates, covariance, by_name, failed, warnings)

    def to_dict(self) -> dict[str, Any]:
        """As ``shearfront fit --json``."""
        on_request = ("profile95", "bootstrap95")
        rows = [
            {k: list(v) if isinstance(v, tuple) else v for k, v in row.items() if v is not None or k not in on_request}
            for row in self._engine.parameters
        ]
        return {
            **self.facts,
            "parameters": rows,
            "correlation": self.correlation.tolist(),
            "covariance": self.covariance.tolist(),
        }

    def to_dataframe(self) -> Any:
        """A row per unknown; needs pandas."""
        rows = []
        for p in self.parameters.values():
            low, high = p.ci95 or (np.nan, np.nan)
            rows.append((p.estimate, p.std_error, low, high, p.start, p.at_bound))
        columns = ["estimate", "std_error", "lower", "upper", "start", "at_bound"]
        return pandas().DataFrame(rows, index=self.names, columns=columns)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws data and fit; see :func:`shearfront.pictures.fit`."""
        from . import pictures

        return pictures.fit(self, ax=ax)

    def __repr__(self) -> str:
        lines = [
            f"{self.problem.name}: {self.facts['observations']} observations ({self.facts['quantity']}), misfit {self.misfit:.6g}"
        ]
        for p in self.parameters.values():
            error = "" if p.std_error is None else f" +- {p.std_error:.2g}"
            lines.append(f"  {p.name} = {p.estimate:.6g}{error}")
        lines += [f"  warning: {w}" for w in self.warnings]
        return "\n".join(lines)


def problem(
    scene: Scene,
    observations: Any,
    unknown: str | Sequence[str],
    *,
    start: Any = None,
    lower: Any = None,
    upper: Any = None,
    shape: str | None = None,
    method: str | None = None,
    quantity: str | None = None,
    loss: str | None = None,
    loss_scale: float | None = None,
    two_stage: bool | None = None,
    algorithm: str | None = None,
    starts: int | None = None,
    seed: int | None = None,
    max_evaluations: int | None = None,
    tolerance: float | None = None,
    profile: bool | None = None,
    bootstrap: int | None = None,
    bootstrap_seed: int | None = None,
    threads: int | None = None,
    name: str | None = None,
    **options: Any,
) -> Problem:
    """A fit that is ready to run; see :func:`fit` for what it takes.

    Examples
    --------
    >>> import shearfront as sf
    >>> bed = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
    >>> seen = bed.observe([0.2, 0.4], [0.3, 0.5, 0.7], quantity="cumulative", noise=0.01)
    >>> sf.problem(bed, seen, "shear_rate.values")
    <Problem 'scene': 6 observations>
    """
    unknowns = [unknown] if isinstance(unknown, str) else list(unknown)
    tables: dict[str, Any] = {
        "name": name or scene.name,
        "unknown": {"parameters": unknowns, "start": start, "lower": lower, "upper": upper, "shape": shape},
        "misfit": {"quantity": quantity, "loss": loss, "loss_scale": loss_scale, "two_stage": two_stage},
        "search": {
            "algorithm": algorithm,
            "starts": starts,
            "seed": seed,
            "max_evaluations": max_evaluations,
            "tolerance": tolerance,
        },
        "uncertainty": {"profile": profile, "bootstrap": bootstrap, "seed": bootstrap_seed, "threads": threads},
    }
    for key in ("start", "lower", "upper"):
        if tables["unknown"][key] is not None:
            tables["unknown"][key] = flat(tables["unknown"][key])
    if method is not None or options:
        tables["forward"] = {"method": method or "exact", **options}
    seen = data(scene, observations)
    with without_places():
        return Problem(_core.parse_fit(toml_text(tables), scene._engine, seen._engine))


def fit(
    scene: Scene | str | os.PathLike[str], observations: Any = None, unknown: str | Sequence[str] = (), **settings: Any
) -> Fit:
    """Finds unknown entries of a scene from observations, with error bars.

    Parameters
    ----------
    scene : Scene or path
        All that is known; or a fit file (TOML), which says everything.
    observations : Observations, path, DataFrame or mapping
        As :func:`data` takes them.
    unknown : str or sequence of str
        Names of entries (:attr:`Scene.entries`): ``"shear_rate.values"`` for all of an array, ``"shear_rate.values[1]"``.
    **settings
        start, lower, upper : array_like, one number per unknown;
        shape : "none", "decreasing" or "convex", the order among the values of a(z);
        method, and options of the method : what predicts the observations;
        quantity : "point", "bin", "cumulative" or "bed-height", what is compared;
        loss : "squared", "huber" or "cauchy"; loss_scale; two_stage;
        algorithm : "ceres", "global" or "nlopt:NAME"; starts; seed; max_evaluations; tolerance;
        profile : bool, bootstrap : int, bootstrap_seed, threads : more intervals;
        name.
        They are those of a fit file (docs/formats.md), with the same defaults.

    Returns
    -------
    Fit

    Raises
    ------
    InputError
        With everything that is wrong with the input.
    NoResult
        If no estimate was found.

    Examples
    --------
    >>> import shearfront as sf
    >>> truth = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = truth.observe([0.2, 0.5, 1], [0.1, 0.3, 0.5, 0.7, 0.9], quantity="cumulative")
    >>> found = sf.fit(truth, seen, ["shear_rate.values"], start=[1, 1])
    >>> found.estimates.round(6)
    array([2.4 , 0.31])
    """
    if not isinstance(scene, Scene):
        if observations is not None or unknown or settings:
            raise TypeError("a fit file says everything: give it alone")
        return read_fit(scene).run()
    if observations is None or not unknown:
        raise TypeError("fit needs observations and the names of what is unknown")
    return problem(scene, observations, unknown, **settings).run()


def read_fit(path: str | os.PathLike[str]) -> Problem:
    """Reads a fit file with its scene and its observations.

    Parameters
    ----------
    path : path
        Of a fit file (TOML).

    Returns
    -------
    Problem
        Which is run by ``.run()``.

    Raises
    ------
    InputError
        With every complaint about the file and those it names.

    Examples
    --------
    >>> import shearfront as sf, tempfile, pathlib
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
    >>> scene.save(folder / "scene.toml")
    >>> scene.observe([0.2], [0.4, 0.5], quantity="cumulative").save(folder / "seen.csv")
    >>> text = "scene = 'scene.toml'\\nobservations = 'seen.csv'\\n[unknown]\\nparameters = ['shear_rate.values']"
    >>> _ = (folder / "fit.toml").write_text(text)
    >>> sf.read_fit(folder / "fit.toml")
    <Problem 'fit': 2 observations>
    """
    return Problem(_core.read_fit(os.fspath(path)))


def compare_fits(fits: Mapping[str, Fit]) -> Any:
    """Several models for the same observations, best AIC first.

    Parameters
    ----------
    fits : mapping
        By the name each model is to have.

    Returns
    -------
    ndarray
        Structured: model, parameters, misfit, aic, daic, aic_weight, bic, dbic; NaN where there is no criterion.

    Raises
    ------
    InputError
        If they have other observations, quantities or losses.

    Examples
    --------
    >>> import shearfront as sf
    >>> truth = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = truth.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7, 0.9], quantity="cumulative", noise=0.001)
    >>> two = sf.fit(truth, seen, "shear_rate.values")
    >>> one = sf.fit(truth.with_(shear_rate=sf.Piecewise([], [1])), seen, "shear_rate.values")
    >>> sf.compare_fits({"one layer": one, "two layers": two})["model"].tolist()
    ['two layers', 'one layer']
    """
    rows = _core.compare_fits(list(fits), [f._engine for f in fits.values()])
    kind = [("model", "U64"), ("parameters", int), ("misfit", float), ("aic", float), ("daic", float)]
    kind += [("aic_weight", float), ("bic", float), ("dbic", float)]
    return np.array([tuple(np.nan if x is None else x for x in row) for row in rows], dtype=kind)


__all__ = [
    "Bootstrap",
    "Fit",
    "InputError",
    "Misfit",
    "Parameter",
    "Prediction",
    "Problem",
    "RateBand",
    "compare_fits",
    "fit",
    "problem",
    "read_fit",
]
