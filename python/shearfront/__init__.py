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

import importlib
from typing import TYPE_CHECKING, Any

from ._callables import Sampled, sampled
from ._data import Observations, data, read_data
from ._errors import Complaint, InputError, NoResult
from ._methods import methods
from ._models import *  # noqa: F403  (a class for every model of the library)
from ._models import __all__ as _model_names
from ._scene import Scene, read
from ._solution import Events, Interface, Jacobian, Solution

if TYPE_CHECKING:
    from . import pictures
    from ._estimate import Bootstrap, Fit, Parameter, Prediction, RateBand
    from ._fit import Problem, compare_fits, fit, problem, read_fit
    from ._misfit import Misfit
    from ._petab import petab
    from ._posterior import Posterior
    from ._priors import HalfNormal, LogNormal, Normal, Prior, Uniform
    from ._profile import MisfitProfile
    from ._smooth import SmoothFit
    from ._study import Study, study
    from ._tracking import Profile, Tracking
    from ._umbridge import umbridge

__version__ = "0.1.0"

#: What is loaded when it is first asked for: who draws one solution does not wait for the rest.
_LAZY = {
    "pictures": ("pictures",),
    "_estimate": ("Bootstrap", "Fit", "Parameter", "Prediction", "RateBand"),
    "_fit": ("Problem", "compare_fits", "fit", "problem", "read_fit"),
    "_misfit": ("Misfit",),
    "_petab": ("petab",),
    "_posterior": ("Posterior",),
    "_priors": ("HalfNormal", "LogNormal", "Normal", "Prior", "Uniform"),
    "_profile": ("MisfitProfile",),
    "_smooth": ("SmoothFit",),
    "_study": ("Study", "study"),
    "_tracking": ("Profile", "Tracking"),
    "_umbridge": ("umbridge",),
}

__all__ = [
    "Bootstrap",
    "Complaint",
    "Events",
    "Fit",
    "HalfNormal",
    "InputError",
    "Interface",
    "Jacobian",
    "LogNormal",
    "Misfit",
    "MisfitProfile",
    "NoResult",
    "Normal",
    "Observations",
    "Parameter",
    "Posterior",
    "Prediction",
    "Prior",
    "Problem",
    "Profile",
    "RateBand",
    "Sampled",
    "Scene",
    "SmoothFit",
    "Solution",
    "Study",
    "Tracking",
    "Uniform",
    "compare_fits",
    "data",
    "fit",
    "methods",
    "petab",
    "pictures",
    "problem",
    "read",
    "read_data",
    "read_fit",
    "sampled",
    "study",
    "umbridge",
]
__all__ += _model_names


def __getattr__(name: str) -> Any:
    for module, names in _LAZY.items():
        if name in names:
            loaded = importlib.import_module(f".{module}", __name__)
            value = loaded if name == module else getattr(loaded, name)
            globals()[name] = value
            return value
    raise AttributeError(f"module 'shearfront' has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
