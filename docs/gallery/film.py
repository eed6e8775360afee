# A run as a film
# Front tracking of the two layers: left the fronts so far, right φ(z) now.
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation

import shearfront as sf

scene = sf.read("datasets/may-2010-piecewise/scene.toml")
bed = scene.track(0.06)
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.6), layout="constrained", width_ratios=(1.6, 1), sharey=True)


def draw(t):
    bed.advance(t)
    left.clear()
    right.clear()
    for f in bed.fronts():
        jump = abs(f["phi_above"] - f["phi_below"])
        left.plot(
            [f["t_begin"], f["t_end"]], [f["z_begin"], f["z_end"]], linewidth=2.5 if jump > 0.15 else 0.7,
            color=sf.pictures.PHI((f["phi_above"] + f["phi_below"]) / 2),
        )  # fmt: skip
    left.axvline(t, color="grey", linewidth=0.8)
    left.axhline(0.29, color="grey", linestyle="--", linewidth=0.8)
    left.set(xlim=(0, 6.6), ylim=(-0.02, 1.02), xlabel="t", ylabel="z")
    right.plot(*bed.profile().line(), color=sf.pictures.COLOURS[0])
    right.set(xlim=(-0.05, 1.05), xlabel="φ", title=f"t = {t:.1f}")


film = FuncAnimation(figure, draw, np.linspace(0, 6.5, 53))
