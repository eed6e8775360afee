# A study of 2000 beds
# Two rates and the height of the interface between the grains are not known exactly. When is the bed segregated, and when does
# the first wave come to the bottom?
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.read("datasets/may-2010-piecewise/scene.toml")
random = np.random.default_rng(7)
points = {
    "shear_rate.values[0]": random.uniform(1.5, 3.5, 2000),
    "shear_rate.values[1]": 0.31 * np.exp(0.1 * random.standard_normal(2000)),
    "initial.breaks[0]": random.normal(0.5, 0.02, 2000),
}
rows = [dict(zip(points, values)) for values in zip(*points.values())]
table = sf.study(scene, rows, ["t0", "t_star"])
figure, axes = plt.subplots(1, 2, figsize=(8, 3.8), layout="constrained", sharey="row")
for ax, name in zip(axes, list(points)[:2]):
    ax.plot(points[name], table["t_star"], ".", ms=2, color=sf.pictures.COLOURS[0])
    ax.set(xlabel=name, ylabel="t*")
