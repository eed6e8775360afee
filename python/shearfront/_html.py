# SPDX-License-Identifier: BSD-3-Clause
"""A scene as a notebook shows it: its parts, and small pictures of a(z) and phi(z, 0)."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from ._arrays import FloatArray
    from ._scene import Scene

_WIDTH, _HEIGHT = 120, 110


def scene_html(scene: Scene, parts: list[tuple[str, str]]) -> str:
    """The table of parts beside the pictures."""
    rows = "".join(f"<tr><td><b>{escape(k)}</b></td><td style='text-align:left'>{escape(v)}</td></tr>" for k, v in parts)
    z = _heights(scene)
    pictures = _picture("s a(z)", z, scene.shear_rate(z) * scene._engine.scale, "#0072b2") + _picture(
        "&phi;(z, 0)", z, scene.initial_phi(z), "#d55e00"
    )
    return (
        "<div style='display:flex;gap:1em;align-items:center;flex-wrap:wrap'>"
        f"<div style='display:flex'>{pictures}</div><table>{rows}</table></div>"
    )


def _heights(scene: Scene) -> FloatArray:
    """Even heights, and both sides of every knot and jump."""
    span = scene.top - scene.bottom
    knots = np.concatenate((scene._engine.knots, scene._engine.initial_knots))
    around = np.concatenate((knots - 1e-9 * span, knots + 1e-9 * span))
    z = np.unique(np.concatenate((np.linspace(scene.bottom, scene.top, 101), around)))
    return z[(z >= scene.bottom) & (z <= scene.top)]


def _picture(title: str, z: FloatArray, values: FloatArray, colour: str) -> str:
    low, high = min(0.0, float(values.min())), float(values.max())
    x = 4 + (values - low) / ((high - low) or 1) * (_WIDTH - 8)
    y = _HEIGHT - 4 - (z - z[0]) / (z[-1] - z[0]) * (_HEIGHT - 22)
    line = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))
    return (
        f"<svg width='{_WIDTH + 6}' height='{_HEIGHT}' role='img' aria-label='{title}'>"
        f"<text x='4' y='11' font-size='11' fill='currentColor'>{title}: {low:.3g} to {high:.3g}</text>"
        f"<rect x='4' y='18' width='{_WIDTH - 8}' height='{_HEIGHT - 22}' fill='none' stroke='#a0a0a0'/>"
        f"<polyline points='{line}' fill='none' stroke='{colour}' stroke-width='2'/></svg>"
    )
