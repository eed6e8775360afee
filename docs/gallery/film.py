# A run as a film
# Front tracking of the two layers: left the fronts so far, right φ(z) now.
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.collections import LineCollection

import shearfront as sf

scene = sf.read("datasets/may-2010-piecewise/scene.toml")
bed = scene.track(0.06)
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.6), width_ratios=(1.6, 1), sharey=True)


def draw(t):
    bed.advance(t)
    left.clear()
    right.clear()
    f = bed.fronts()
    lines = np.stack([np.column_stack([f["t_begin"], f["z_begin"]]), np.column_stack([f["t_end"], f["z_end"]])], axis=1)
    widths = np.where(np.abs(f["phi_above"] - f["phi_below"]) > 0.15, 2.5, 0.7)
    left.add_collection(LineCollection(lines, colors=sf.pictures.PHI((f["phi_above"] + f["phi_below"]) / 2), linewidths=widths))
    left.axvline(t, color="grey", linewidth=0.8)
    left.axhline(0.29, color="grey", linestyle="--", linewidth=0.8)
    left.set(xlim=(0, 6.6), ylim=(-0.02, 1.02), xlabel="t", ylabel="z")
    right.plot(*bed.profile().line(), color=sf.pictures.COLOURS[0])
    right.set(xlim=(-0.05, 1.05), xlabel="φ", title=f"t = {t:.1f}")


figure.subplots_adjust(bottom=0.15, top=0.9)
film = FuncAnimation(figure, draw, np.linspace(0, 6.5, 40))
