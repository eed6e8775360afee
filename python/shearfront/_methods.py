# SPDX-License-Identifier: BSD-3-Clause
"""Methods of solution with their options."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any, TypeVar

from . import _core
from ._options import Options

#: The exact solution, which most calls ask for.
EXACT = _core.Method("exact", [])


def _text(value: object) -> str:
    if hasattr(value, "item"):  # a number of numpy
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else repr(value)


def option_texts(options: Mapping[str, object]) -> list[tuple[str, str]]:
    """Options as the command line spells them; those that are None are left at their defaults."""
    return [(name.replace("_", "-"), _text(value)) for name, value in options.items() if value is not None]


def method_of(name: str | _core.Method, options: Mapping[str, object]) -> _core.Method:
    """The method of this name with these options."""
    if name == "exact" and not options:
        return EXACT
    if isinstance(name, _core.Method):
        return name
    return _core.Method(name, option_texts(options))


_Function = TypeVar("_Function", bound=Callable[..., Any])


def with_options(function: _Function, *others: inspect.Parameter) -> _Function:
    """Spells ``**options`` out in the signature, so that notebooks complete the options of all methods."""
    signature = inspect.signature(function)
    named = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
    known = {p.name for p in (*named, *others)}
    options = [
        inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=getattr(kind, "__forward_arg__", kind))
        for name, kind in Options.__annotations__.items()
        if name not in known
    ]
    function.__signature__ = signature.replace(parameters=[*named, *others, *options])  # type: ignore[attr-defined]
    return function


@lru_cache(maxsize=1)
def methods() -> dict[str, dict[str, Any]]:
    """Every method of solution with what it promises and its options.

    Returns
    -------
    dict
        By name: ``description``, ``scenes`` (which it solves), ``exact``, ``has_fronts``, ``has_timeline``,
        ``has_profiles``, and ``options``: by name their ``kind``, ``sentence``, ``allowed`` and ``default``.

    Examples
    --------
    >>> import shearfront as sf
    >>> sf.methods()["engquist-osher"]["options"]["cells"]["sentence"]
    'number of cells'
    """
    table = {}
    for method in _core.methods():
        facts = dict(method)
        facts["options"] = {
            name.replace("-", "_"): {"kind": kind, "sentence": sentence, "allowed": allowed, "default": default}
            for name, kind, sentence, allowed, default in facts["options"]
        }
        table[facts.pop("name")] = facts
    return table
