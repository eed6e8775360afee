# Profiles of φ
# Exact φ over height at five times: first a fan opens, then pure grains grow from both walls.
import numpy as np

import shearfront as sf

scene = sf.read("datasets/may-2010-piecewise/scene.toml")
figure = sf.pictures.profiles(scene.solve([0, 0.5, 2, 4, "steady"], np.linspace(0, 1, 1001))).figure
