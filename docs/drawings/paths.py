# Cheapest paths
# Where the grains below a height came from: the cheapest path to each of some points, followed back with the speed of its wave.
# Left: in the shear cell of May, Shearer and Daniels paths are bent where the rate changes. Right: with the slow layer below,
# some paths arrive at the interface, rest there (thick), because no more can pass, and go on.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf


def path(scene, z, t):
    """Corners of the path that ends in (z, t): straight in a layer, H = s a φ (1 - φ) is the same in all of it."""
    phi = float(scene.phi(z, t))
    H = float(scene.shear_rate(z)) * phi * (1 - phi)
    up = phi > 0.5
    corners = [(t, z)]
    while t > 1e-9:
        a = float(scene.shear_rate(z + (-1e-9 if up else 1e-9)))
        v = a * np.sqrt(max(0.0, 1 - 4 * H / a)) * (1 if up else -1)
        edge = 0.29 if (z - 0.29) * v > 1e-9 else None  # where it came from: against its speed
        if abs(v) < 1e-6:
            return [*corners, (0.0, z)]
        start = t if edge is None else (z - edge) / v
        if edge is None or start >= t:
            return [*corners, (0.0, z - v * t)]
        t, z = t - start, edge
        corners.append((t, z))
        across = float(scene.shear_rate(z + (-1e-6 if up else 1e-6)))
        if across * (1 - 1e-9) < 4 * H:  # nothing comes from there: it rested, and came from the side of its jump
            a = float(scene.shear_rate(z + 1e-6))
            arrived = (0.5 - z) / (a * np.sqrt(1 - 4 * H / a))
            return [*corners, (arrived, z), (0.0, 0.5)]
    return corners


figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained", sharey=True)
for ax, values in zip(axes, ([2.4, 0.31], [0.5, 2.4])):
    scene = sf.Scene(shear_rate=sf.Piecewise([0.29], values), initial=sf.Step(0.5))
    end = 3.0 if values[0] > 1 else 1.5
    for z in np.linspace(0.04, 0.96, 24):
        phi = float(scene.phi(z, end))
        if 1e-9 < phi < 1 - 1e-9:
            corners = path(scene, z, end)
            ax.plot(*zip(*corners), color=sf.pictures.PHI(phi), linewidth=1)
            for (t0, z0), (t1, z1) in zip(corners, corners[1:]):
                if z0 == z1 == 0.29:
                    ax.plot([t0, t1], [z0, z1], color="black", linewidth=3, solid_capstyle="butt")
            ax.plot(end, z, "o", color=sf.pictures.PHI(phi), ms=4)
    ax.axhline(0.29, color="grey", linestyle="--", linewidth=0.8)
    ax.set(xlabel="t", ylim=(0, 1), title=f"s a = {values[0]:g} below, {values[1]:g} above")
axes[0].set_ylabel("z")
