# SPDX-License-Identifier: BSD-3-Clause
"""How the examples in the docstrings of methods begin: the same lines, written once."""

from __future__ import annotations

import re
from typing import TypeVar

#: By the name that an example uses: the line that makes it, and the name which that line uses.
_LINES = {
    "sf": ("import shearfront as sf", ""),
    "scene": ("scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))", "sf"),
    "seen": ('seen = scene.observe([0.5, 1, 2], [0.1, 0.3, 0.5, 0.7], quantity="cumulative", noise=1e-4)', "scene"),
    "found": ('found = sf.fit(scene, seen, "shear_rate.values")', "seen"),
    "posterior": ('posterior = sf.problem(scene, seen, "shear_rate.values").posterior()', "seen"),
    "bed": ("bed = scene.track(0.1)", "scene"),
}
_HEAD = re.compile(r"( *)Examples\n *--------\n")

_Class = TypeVar("_Class", bound=type)


def _beginning(example: str) -> list[str]:
    needed = {name for name in _LINES if re.search(rf"(?<![\w.]){name}\b", example)}
    for name in reversed(_LINES):
        if name in needed:
            needed.add(_LINES[name][1])
    return [line for name, (line, _) in _LINES.items() if name in needed]


def with_examples(cls: _Class) -> _Class:
    """Completes the examples of all methods that do not import the package themselves, so that each runs alone."""
    for method in vars(cls).values():
        text = getattr(method, "__doc__", None) or ""
        head = _HEAD.search(text)
        if head and "import shearfront" not in text:
            lines = "".join(f"{head[1]}>>> {line}\n" for line in _beginning(text[head.end() :]))
            method.__doc__ = text[: head.end()] + lines + text[head.end() :]
    return cls
