# SPDX-License-Identifier: BSD-3-Clause
"""Mixing and segregation of sheared beds of small and large grains.

The direct problem (exact, by front tracking, finite volumes, with diffusion), and the inverse one: the shear rate a(z)
from measured concentrations.

>>> import shearfront as sf
>>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
>>> scene.phi(0.25, 6.0)
1.0
"""

from __future__ import annotations

from typing import Any

from . import _models
from ._callables import Sampled, sampled
from ._data import Observations, data
from ._errors import Complaint, InputError, NoResult
from ._fit import (
    Bootstrap,
    Fit,
    Misfit,
    Parameter,
    Prediction,
    Problem,
    RateBand,
    compare_fits,
    fit,
    problem,
    read_fit,
)
from ._methods import methods
from ._models import Model, Pieces, Step
from ._scene import Scene, read
from ._solution import Events, Interface, Jacobian, Solution
from ._study import Study, study
from ._tracking import Profile, Tracking

__version__ = "0.1.0"

globals().update(_models.MODELS)

__all__ = [
    "Bootstrap",
    "Complaint",
    "Events",
    "Fit",
    "InputError",
    "Interface",
    "Jacobian",
    "Misfit",
    "Model",
    "NoResult",
    "Observations",
    "Parameter",
    "Pieces",
    "Prediction",
    "Problem",
    "Profile",
    "RateBand",
    "Sampled",
    "Scene",
    "Solution",
    "Step",
    "Study",
    "Tracking",
    "compare_fits",
    "data",
    "fit",
    "methods",
    "pictures",
    "problem",
    "read",
    "read_fit",
    "sampled",
    "study",
    *sorted(_models.MODELS),
]


def __getattr__(name: str) -> Any:
    """Pictures are loaded when they are first asked for: matplotlib takes longer than all of this."""
    if name == "pictures":
        import importlib

        return importlib.import_module(".pictures", __name__)
    raise AttributeError(f"module 'shearfront' has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
