# SPDX-License-Identifier: BSD-3-Clause
"""The inverse problem: entries of a scene from observations."""

from __future__ import annotations

import inspect
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from ._arrays import flat
from ._data import Observations, data
from ._errors import without_places
from ._estimate import Fit
from ._examples import with_examples
from ._methods import with_options
from ._misfit import Misfit
from ._scene import Scene
from ._toml import toml_text

if TYPE_CHECKING:
    from ._posterior import Posterior
    from ._priors import Prior
    from ._smooth import SmoothFit


@with_examples
class Problem:
    """A fit that has not run yet: scene, observations, unknowns and settings.

    Its misfit can be handed to searches and samplers of others: ``problem.misfit`` has residuals, Jacobian and a
    log-likelihood. Made by :func:`problem`, or by :func:`read_fit` from a fit file.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-4)
    >>> sf.problem(scene, seen, "shear_rate.values").run().names
    ['shear_rate.values[0]', 'shear_rate.values[1]']
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

    def posterior(self, priors: Mapping[str, Prior] | None = None) -> Posterior:
        """What data and priors together say about the unknowns.

        Parameters
        ----------
        priors : mapping, optional
            By unknown, or by field for all of its entries; flat within the bounds where none is given.

        Returns
        -------
        Posterior

        Examples
        --------
        >>> import shearfront as sf
        >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
        >>> seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-3)
        >>> sf.problem(scene, seen, "shear_rate.values").posterior().names
        ['shear_rate.values[0]', 'shear_rate.values[1]']
        """
        from ._posterior import Posterior

        return Posterior(self, priors)

    def smooth(self, *, weight: float | None = None) -> SmoothFit:
        """A table of a(z) with many points, as smooth as the data let it be.

        Minimises sum r^2 / 2 + w / 2 int (d^2 log a / dx^2)^2 dx, x the height over that of the table: the prior of a bed that is
        all but an exponential. Unknowns beside the values of the table have no prior. w is where the probability of the data, by
        Laplace's method, is largest (MacKay 1992, Neural Computation 4, 415-447), looked for from the stiffest on, of which there
        is one valley only. Data without sigma have it integrated out. The loss of the fit plays no part. Bands are those of a
        Gaussian at the peak, and right on average over the heights of a smooth a(z). Needs scipy. Cost: some 100 evaluations.

        Parameters
        ----------
        weight : float, optional
            w, if it is known.

        Returns
        -------
        SmoothFit

        Raises
        ------
        InputError
            If the unknowns do not include all values of a table of at least 3 points.

        Examples
        --------
        >>> bed = scene.with_(shear_rate=sf.Table([0, 0.25, 0.5, 0.75, 1], [2, 1.2, 0.7, 0.4, 0.25]))
        >>> sf.problem(bed, seen, "shear_rate.values").smooth().names[0]
        'shear_rate.values[0]'
        """
        from ._smooth import smooth_fit

        return smooth_fit(self, weight)

    def run(self) -> Fit:
        """Finds the unknowns.

        Raises
        ------
        NoResult
            If no estimate was found.

        Returns
        -------
        Fit

        Examples
        --------
        >>> sf.problem(scene, seen, "shear_rate.values").run().estimates.round(1)
        array([2.4, 0.3])
        """
        return Fit(self, self._engine.run())

    def with_(self, numbers: Mapping[str, float]) -> Problem:
        """The same fit with other numbers of its scene, by the names of their entries.

        Parameters
        ----------
        numbers : mapping
            By the names of entries of the scene.

        Returns
        -------
        Problem

        Examples
        --------
        >>> problem = sf.problem(scene, seen, "shear_rate.values")
        >>> problem.with_({"initial.breaks[0]": 0.52}).scene.entries["initial.breaks[0]"]
        0.52
        """
        return Problem(self._engine.with_scene(self.scene.with_(numbers)._engine))

    def __reduce__(self) -> tuple[Any, ...]:
        return _problem_of, (self._engine.state,)

    def __repr__(self) -> str:
        return f"<Problem {self.name!r}: {len(self.observations)} observations>"


def _problem_of(state: Any) -> Problem:
    return Problem(_core.problem_of_state(*state))


@with_options
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
    method_options: Mapping[str, object] | None = None,
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
    noise: str | Mapping[str, object] | None = None,
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
        "noise": {"model": noise} if isinstance(noise, str) else noise,
    }
    for key in ("start", "lower", "upper"):
        if tables["unknown"][key] is not None:
            tables["unknown"][key] = flat(tables["unknown"][key])
    options |= method_options or {}
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
        method, and options of the method : what predicts the observations; method_options : a mapping of such as have a name of
        these settings, ``{"tolerance": 1e-4}``;
        quantity : "point", "bin", "cumulative" or "bed-height", what is compared;
        loss : "squared", "huber" or "cauchy"; loss_scale; two_stage;
        algorithm : "ceres", "global" or "nlopt:NAME"; starts; seed; max_evaluations; tolerance;
        profile : bool, bootstrap : int, bootstrap_seed, threads : more intervals;
        noise : "independent", "exponential" or "discrepancy", or a mapping as [noise], ``{"model": "exponential",
        "length_z": 0.1}``;
        name.
        They are those of a fit file (docs/reference/formats.md), with the same defaults.

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


with_options(fit, *(p for p in inspect.signature(problem).parameters.values() if p.kind is p.KEYWORD_ONLY))


def read_fit(path: str | os.PathLike[str], numbers: Mapping[str, float] | None = None) -> Problem:
    """Reads a fit file with its scene and its observations.

    Parameters
    ----------
    path : path
        Of a fit file (TOML).
    numbers : mapping, optional
        Numbers to put in the place of those of its scene, by the names of their entries.

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
    return Problem(_core.read_fit(os.fspath(path), [(name, repr(float(value))) for name, value in (numbers or {}).items()]))


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
