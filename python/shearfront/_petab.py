# SPDX-License-Identifier: BSD-3-Clause
"""A fit as tables of PEtab, a format of parameter estimation problems that other programs read."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._errors import one_complaint
from ._misfit import Misfit
from ._posterior import priors_of
from ._priors import LogNormal, Normal, Uniform

if TYPE_CHECKING:
    from ._fit import Problem
    from ._priors import Prior

_Table = dict[str, list[Any]]
_QUANTITY = {"point": "phi", "bin": "phi", "cumulative": "M", "bed-height": "H"}
_CONDITION = "scene"


def petab(problem: Problem, folder: str | os.PathLike[str], priors: Mapping[str, Prior] | None = None) -> dict[str, _Table]:
    """Writes the measurements and the unknowns of a fit as the tables ``measurements.tsv`` and ``parameters.tsv`` of PEtab 1.

    An observable is a quantity at one height, ``phi_1``, ``M_2``, or ``H``; its height and width are in columns of our own.
    Unknowns are named as PEtab asks, ``shear_rate_values_0``, with their own name as ``parameterName``; those that are positive
    have the scale ``log10``. What has no place in PEtab is left out: the scene, misfits that are not squares, shapes, correlated
    noise.

    Parameters
    ----------
    problem : Problem
    folder : path
        Made if it is missing; what is there by these names is overwritten.
    priors : mapping, optional
        As :meth:`Problem.posterior` takes them: normal, log-normal or uniform.

    Raises
    ------
    InputError
        For a prior that PEtab has no name for.

    Returns
    -------
    dict of dict of list
        The same tables by the names of their files: columns of ``pandas.DataFrame``.

    Examples
    --------
    >>> import tempfile
    >>> import shearfront as sf
    >>> bed = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
    >>> seen = bed.observe([0.2, 0.4], [0.3, 0.5], quantity="cumulative", noise=0.01)
    >>> tables = sf.petab(sf.problem(bed, seen, "shear_rate.values"), tempfile.mkdtemp())
    >>> tables["measurements.tsv"]["observableId"]
    ['M_1', 'M_2', 'M_1', 'M_2']
    >>> tables["parameters.tsv"]["parameterId"], tables["parameters.tsv"]["parameterScale"]
    (['shear_rate_values_0'], ['log10'])
    """
    tables = {"measurements.tsv": _measurements(problem), "parameters.tsv": _parameters(problem, priors)}
    Path(folder).mkdir(parents=True, exist_ok=True)
    for name, table in tables.items():
        rows = [list(table), *zip(*table.values(), strict=True)]
        text = "".join("\t".join(_text(value) for value in row) + "\n" for row in rows)
        (Path(folder) / name).write_text(text, encoding="utf-8")
    return tables


def _text(value: Any) -> str:
    return repr(value) if isinstance(value, float) else str(value)


def _measurements(problem: Problem) -> _Table:
    seen = problem.observations
    name, is_height = _QUANTITY[seen.quantity], seen.quantity == "bed-height"
    places = list(zip(seen.z.tolist(), seen.width.tolist(), strict=True))
    numbers = {place: i + 1 for i, place in enumerate(dict.fromkeys(places))}
    sigma = [s if s > 0 else math.nan for s in seen.sigma.tolist()]
    table: _Table = {
        "observableId": [name if is_height else f"{name}_{numbers[place]}" for place in places],
        "simulationConditionId": [_CONDITION] * len(places),
        "measurement": seen.value.tolist(),
        "time": seen.t.tolist(),
    }
    if not any(math.isnan(s) for s in sigma):
        table["noiseParameters"] = sigma
    if not is_height:
        table["z"] = [z for z, _ in places]
    if seen.quantity == "bin":
        table["width"] = [width for _, width in places]
    return table


def _parameters(problem: Problem, priors: Mapping[str, Prior] | None) -> _Table:
    misfit = Misfit(problem)
    known = priors_of(problem, priors)
    columns = zip(misfit.names, misfit.lower.tolist(), misfit.upper.tolist(), misfit.start.tolist(), strict=True)
    table: _Table = {
        key: []
        for key in (
            "parameterId",
            "parameterName",
            "parameterScale",
            "lowerBound",
            "upperBound",
            "nominalValue",
            "estimate",
            "objectivePriorType",
            "objectivePriorParameters",
        )
    }
    for name, lower, upper, start in columns:
        kind, numbers = _prior(name, known[name])
        low, high = max(lower, known[name].low), min(upper, known[name].high)
        row = (
            re.sub(r"\W+", "_", name).strip("_"),
            name,
            "log10" if low > 0 else "lin",
            low,
            high,
            start,
            1,
            kind,
            ";".join(repr(float(x)) for x in numbers),
        )
        for column, value in zip(table.values(), row, strict=True):
            column.append(value)
    if not any(table["objectivePriorType"]):
        del table["objectivePriorType"], table["objectivePriorParameters"]
    return table


def _prior(name: str, prior: Prior) -> tuple[str, tuple[float, ...]]:
    if isinstance(prior, Normal):
        return "normal", (prior.mean, prior.std)
    if isinstance(prior, LogNormal):
        return "logNormal", (math.log(prior.median), prior.sigma)
    if isinstance(prior, Uniform):
        is_bounded = math.isfinite(prior.low) and math.isfinite(prior.high)
        return ("uniform", (prior.low, prior.high)) if is_bounded else ("", ())
    raise one_complaint("prior", name, "must be normal, log-normal or uniform: PEtab has no name for another")
