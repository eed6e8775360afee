# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong: bad input, and computations that end without a result."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple


class Complaint(NamedTuple):
    """One thing that is wrong with an input.

    Attributes
    ----------
    key : str
        The entry, ``"shear_rate.values[1]"``; elements are counted from 0.
    value : str
        The offending value; empty where there is none.
    constraint : str
        What is allowed, ``"must be > 0"``.
    text : str
        All of it in one line.
    """

    key: str
    value: str
    constraint: str
    text: str


class InputError(ValueError):
    """An input that cannot be used.

    Attributes
    ----------
    complaints : list of Complaint
        Everything that is wrong with it, not only the first.

    Examples
    --------
    >>> import shearfront as sf
    >>> try:
    ...     sf.Scene(shear_rate=sf.Piecewise([0.3], [2.4, -0.3]), initial=sf.Step(1.5))
    ... except sf.InputError as error:
    ...     for complaint in error.complaints:
    ...         print(complaint.text)
    shear_rate.values[1] = -0.3; must be > 0
    initial.breaks[0] = 1.5; must be inside the domain (0, 1)
    """

    def __init__(self, message: str, complaints: list[tuple[str, str, str, str]] | None = None) -> None:
        super().__init__(message)
        self.complaints = [Complaint(*c) for c in complaints or []]

    def __reduce__(self) -> tuple[type[InputError], tuple[str, list[tuple[str, str, str, str]]]]:
        return InputError, (str(self), [(c.key, c.value, c.constraint, c.text) for c in self.complaints])


class NoResult(RuntimeError):
    """A computation that ended without a usable result.

    Attributes
    ----------
    status : str
        How it ended: ``"unsupported"``, ``"budget_reached"``, ``"not_converged"``, ``"diverged"`` or ``"interrupted"``.

    Examples
    --------
    >>> import shearfront as sf
    >>> scene = sf.Scene(shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
    >>> try:
    ...     scene.solve(1, method="crank-nicolson")
    ... except sf.NoResult as error:
    ...     print(error.status)
    unsupported
    """

    def __init__(self, message: str, status: str = "unsupported") -> None:
        super().__init__(message)
        self.status = status

    def __reduce__(self) -> tuple[type[NoResult], tuple[str, str]]:
        return NoResult, (str(self), self.status)


@contextmanager
def without_places() -> Iterator[None]:
    """Complaints about keywords name no lines of the text that was made from them."""
    try:
        yield
    except InputError as error:
        raise InputError(
            "\n".join(c.text for c in error.complaints), [(c.key, c.value, c.constraint, c.text) for c in error.complaints]
        ) from None


def one_complaint(key: str, value: object, constraint: str) -> InputError:
    """An InputError about a single entry."""
    shown = "" if value is None else str(value)
    text = f"{key} = {shown}; {constraint}" if shown else f"{key}: {constraint}"
    return InputError(text, [(key, shown, constraint, text)])
