# My bed
# All fronts of the bed of this page, and φ(z) at three times.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.Scene(
    shear_rate=sf.Piecewise([10, 20], [6, 2, 0.5]), initial=sf.Pieces([15], [0, 0.8]), domain=(0, 30),
    units={"z": "mm", "t": "min"},
)  # fmt: skip
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained", width_ratios=(1.6, 1))
bed = scene.track(0.05)
bed.advance(np.inf)
sf.pictures.fronts(bed, left, events=scene.events())
sf.pictures.profiles(scene.solve([5, 20, 40], np.linspace(0, 30, 601)), right)
