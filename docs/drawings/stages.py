# What happens in the bed
# The bed as one would see it through a glass wall: dark large grains, light small ones. At the start, while it mixes, while it
# segregates, at rest.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.read("datasets/may-2010-piecewise/scene.toml")
random = np.random.default_rng(3)
times = [0, 1.0, 3.0, 6.5]
figure, axes = plt.subplots(1, 4, figsize=(9, 3.2), layout="constrained")
for ax, t in zip(axes, times):
    n = 4000
    x, z = random.random(n), random.random(n)
    small = random.random(n) < scene.phi(z, t)
    ax.plot(x[~small], z[~small], "o", ms=4, mec="none", color=sf.pictures.PHI(0.0))
    ax.plot(x[small], z[small], "o", ms=2.2, mec="none", color=sf.pictures.PHI(1.0))
    ax.set(title=f"t = {t:g}", xticks=[], xlim=(0, 1), ylim=(0, 1))
axes[0].set_ylabel("z")
