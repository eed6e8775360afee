# First and second order
# Front tracking against the exact solution: φ is of first order in the resolution, M of second.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.read("datasets/may-2010-piecewise/scene.toml")
z = np.linspace(0, 1, 4001)
exact = scene.solve([0.5], z)
steps = [0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001]
runs = [scene.solve([0.5], z, method="front-tracking", resolution=d) for d in steps]
figure, ax = plt.subplots(figsize=(4.6, 4.2), layout="constrained")
ax.loglog(steps, [np.abs(r.phi - exact.phi).mean() for r in runs], "o-", color=sf.pictures.COLOURS[0], label="φ, mean error")
ax.loglog(steps, [np.abs(r.M - exact.M).max() for r in runs], "s-", color=sf.pictures.COLOURS[1], label="M, largest error")
ax.set(xlabel="resolution", ylabel="error at t = 0.5")
ax.legend(frameon=False)
