# SPDX-License-Identifier: BSD-3-Clause
"""The same scene, or the same fit, many times with other numbers."""

from __future__ import annotations

import itertools
import math
import re
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import pandas
from ._errors import InputError, NoResult, one_complaint
from ._estimate import Fit
from ._examples import with_examples
from ._fit import Problem
from ._methods import with_options
from ._scene import Scene

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from typing_extensions import Unpack

    from ._arrays import FloatArray
    from ._options import Options

#: A task for another process takes at least this long, in seconds: less is spent on sending it.
_LEAST_TASK = 0.2
#: How long runs are timed here before the others are sent away.
_TRIAL = 0.02

Row = dict[str, float]
#: What a run of one point gives, and why it gave nothing.
Outcome = tuple[Row, str]


@with_examples
@dataclass(frozen=True)
class Study:
    """The rows of a study, in the order of its points whoever ran them.

    Attributes
    ----------
    entries : dict of ndarray
        The numbers that varied, by the names of their entries.
    outputs : dict of ndarray
        By name; NaN after a failure, infinity for an event that never comes.
    failures : dict of str
        By the number of the run, why it has no result.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> found = sf.study(scene, {"initial.breaks[0]": [0.4, 0.5]})
    >>> len(found), list(found.outputs)
    (2, ['t_star'])
    """

    entries: dict[str, FloatArray]
    outputs: dict[str, FloatArray] = field(repr=False)
    failures: dict[int, str]

    def __repr__(self) -> str:
        return f"<Study of {len(self)} runs, {len(self.failures)} of them failed: {', '.join([*self.entries, *self.outputs])}>"

    def __getitem__(self, name: str) -> FloatArray:
        """A column."""
        return self.entries[name] if name in self.entries else self.outputs[name]

    def __len__(self) -> int:
        return len(next(iter(self.entries.values()), ()))

    def to_dataframe(self) -> Any:
        """All columns and one of failures; needs pandas.

        Returns
        -------
        pandas.DataFrame

        Examples
        --------
        >>> sf.study(scene, {"initial.breaks[0]": [0.4, 0.5]}).to_dataframe().shape
        (2, 3)
        """
        failures = [self.failures.get(i, "") for i in range(len(self))]
        return pandas().DataFrame({**self.entries, **self.outputs, "failure": failures})


@with_options
def study(
    of: Scene | Problem | Fit,
    parameters: Any,
    outputs: Sequence[str] | Callable[[Any], Mapping[str, float]] = ("t_star",),
    *,
    executor: Executor | None = None,
    batch: int | None = None,
    method: str = "exact",
    **options: Unpack[Options],
) -> Study:
    """Runs a scene, or a fit, at many points.

    Parameters
    ----------
    of : Scene, Problem or Fit
        Of a fit everything is fitted again at each point, with the same observations.
    parameters : mapping, DataFrame or sequence of mappings
        Values by the names of entries. Those of a mapping are combined with each other, the last varies fastest; a table
        or a sequence gives the points one by one.
    outputs : sequence of str or callable, optional
        Of a scene: "t0", "t1", "t_star", "t_c(1)" and "t^_c(1)" (first and last wave at the first interface),
        "phi(t;z)", "M(t;z)", "mixing(t)", "height(t)" with numbers in the brackets. Or a function of the
        scene, or of the :class:`Fit`, that gives numbers by name; for processes it must be one that can be pickled. A fit has its
        estimates and its misfit unless a function is given.
    executor : concurrent.futures.Executor, optional
        Processes, threads, ``dask.distributed.Client.get_executor()``, ``mpi4py.futures.MPIPoolExecutor``; here and now
        unless given.
    batch : int, optional
        Points per task; as many as take 0.2 s unless given.
    method, **options
        As in :meth:`Scene.solve`; a fit has its own.

    Returns
    -------
    Study
        The same to the bit, and in the same order, whatever the executor.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> found = sf.study(scene, {"shear_rate.values[1]": [0.31, 0.62]}, ["t_star", "phi(0.5;0.75)"])
    >>> found["t_star"].round(3)
    array([6.452, 3.226])
    """
    points = _points(parameters)
    names = list(points[0]) if points else []
    base: Scene | Problem = of.problem if isinstance(of, Fit) else of
    known = base.scene.entries if isinstance(base, Problem) else base.entries
    for name in names:
        if name not in known:
            raise one_complaint(f"parameters[{name!r}]", None, "is no entry of the scene")
    work: Callable[[Any], Mapping[str, float]]
    if callable(outputs):
        work = outputs
    elif isinstance(base, Problem):
        work = _fit_outputs
    else:
        work = SceneOutputs(tuple(outputs), method, tuple(options.items()))
    outcomes = _run_all(base, points, work, executor, batch)
    columns = list(dict.fromkeys(name for row, _ in outcomes for name in row))
    return Study(
        {name: np.array([p[name] for p in points]) for name in names},
        {name: np.array([row.get(name, np.nan) for row, _ in outcomes]) for name in columns},
        {i: why for i, (_, why) in enumerate(outcomes) if why},
    )


def _points(parameters: Any) -> list[Row]:
    if isinstance(parameters, Mapping):
        values = [[float(x) for x in np.atleast_1d(np.asarray(v, dtype=float))] for v in parameters.values()]
        return [dict(zip(parameters, row, strict=True)) for row in itertools.product(*values)]
    if hasattr(parameters, "columns"):
        columns = {str(name): np.asarray(parameters[name], dtype=float) for name in parameters.columns}
        return [dict(zip(columns, map(float, row), strict=True)) for row in zip(*columns.values(), strict=True)]
    points = [{str(k): float(v) for k, v in p.items()} for p in parameters]
    if any(list(p) != list(points[0]) for p in points):
        raise one_complaint("parameters", None, "must name the same entries at every point")
    return points


def _run_all(base: Any, points: list[Row], work: Any, executor: Executor | None, batch: int | None) -> list[Outcome]:
    if executor is None:
        return _run(base, points, work)
    outcomes: list[Outcome] = []
    if batch is None:
        begin = time.perf_counter()
        while len(outcomes) < len(points) and time.perf_counter() - begin < _TRIAL:
            outcomes += _run(base, points[len(outcomes) : len(outcomes) + 1], work)
        each = (time.perf_counter() - begin) / max(len(outcomes), 1)
        batch = max(1, math.ceil(_LEAST_TASK / max(each, 1e-7)))
    rest = points[len(outcomes) :]
    tasks: list[Future[list[Outcome]]] = [
        executor.submit(_run, base, rest[i : i + batch], work) for i in range(0, len(rest), batch)
    ]
    for task in tasks:
        outcomes += task.result()
    return outcomes


def _run(base: Any, points: Iterable[Row], work: Callable[[Any], Mapping[str, float]]) -> list[Outcome]:
    """Runs some points; what every worker does."""
    outcomes: list[Outcome] = []
    for point in points:
        try:
            at = base.with_(point)
            found = work(at.run() if isinstance(at, Problem) else at)
            outcomes.append(({name: float(value) for name, value in found.items()}, ""))
        except (InputError, NoResult) as error:
            outcomes.append(({}, str(error)))
    return outcomes


def _fit_outputs(fit: Fit) -> Row:
    return {**{p.name: p.estimate for p in fit.parameters.values()}, "misfit": fit.misfit}


_EVENT = re.compile(r"(t0|t1|t_star|mass|steady_height)|(t_c|t\^_c)(?:\((\d+)\))?")
_SAMPLE = re.compile(r"(phi|M)\(([^;]+);([^;]+)\)")
_COURSE = re.compile(r"(mixing|entropy|height)\(([^;]+)\)")


class SceneOutputs:
    """Numbers of a scene by their names, with one run for those of a kind."""

    def __init__(self, names: tuple[str, ...], method: str, options: tuple[tuple[str, Any], ...]) -> None:
        self.names, self.method, self.options = names, method, options
        self.events: list[tuple[str, re.Match[str]]] = []
        self.samples: list[tuple[str, str, float, float]] = []
        self.course: list[tuple[str, str, float]] = []
        for name in names:
            try:
                if event := _EVENT.fullmatch(name):
                    self.events.append((name, event))
                elif sample := _SAMPLE.fullmatch(name):
                    self.samples.append((name, sample[1], float(sample[2]), float(sample[3])))
                elif course := _COURSE.fullmatch(name):
                    self.course.append((name, course[1], float(course[2])))
                else:
                    raise ValueError
            except ValueError:
                known = "t0, t1, t_star, t_c(k), t^_c(k), mass, steady_height, phi(t;z), M(t;z), mixing(t), entropy(t), height(t)"
                raise one_complaint("outputs", repr(name), f"must be one of: {known}") from None

    def __reduce__(self) -> tuple[Any, ...]:
        return SceneOutputs, (self.names, self.method, self.options)

    def __call__(self, scene: Scene) -> Row:
        found: Row = {}
        options = dict(self.options)
        if self.events:
            events = scene.events(method=self.method, **options)
            for name, match in self.events:
                found[name] = _event(events, match)
        if self.samples:
            z, t = [s[3] for s in self.samples], [s[2] for s in self.samples]
            values = {q: getattr(scene, q)(z, t, method=self.method, **options) for q in {s[1] for s in self.samples}}
            for i, (name, quantity, _, _) in enumerate(self.samples):
                found[name] = float(values[quantity][i])
        if self.course:
            bed = scene.bed([c[2] for c in self.course], method=self.method, **options)
            for i, (name, quantity, _) in enumerate(self.course):
                if quantity not in bed:
                    raise NoResult(f"the bed has no {quantity}")
                found[name] = float(bed[quantity][i])
        return {name: found[name] for name in self.names}


def _event(events: Any, match: re.Match[str]) -> float:
    if match[1]:
        value = getattr(events, match[1])
    else:
        k = int(match[3] or 1)
        if not 1 <= k <= len(events.interfaces):
            raise NoResult(f"the scene has {len(events.interfaces)} interfaces, not {k}")
        value = events.interfaces[k - 1].first if match[2] == "t_c" else events.interfaces[k - 1].last
    return math.inf if value is None else float(value)
