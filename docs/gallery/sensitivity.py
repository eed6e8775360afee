# What each rate changes
# Exact derivatives of M, the amount of small grains below a height, by the rates of both layers: where to measure to learn
# them.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.read("datasets/may-2010-piecewise/scene.toml")
t, z = np.linspace(0.02, 6.6, 200), np.linspace(0, 1, 201)
names = ["shear_rate.values[0]", "shear_rate.values[1]"]
j = scene.jacobian(z[None, :], t[:, None], names)
figure, axes = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained", sharey=True)
for ax, name in zip(axes, names):
    change = j.of_M(name).reshape(len(t), len(z))
    image = ax.pcolormesh(t, z, change.T, cmap="PuOr", vmin=-np.abs(change).max(), vmax=np.abs(change).max(), rasterized=True)
    ax.set(title=name, xlabel="t", ylabel="z")
    figure.colorbar(image, ax=ax, label="∂M")
