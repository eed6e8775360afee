# A fan
# Small grains above large ones, one layer. Left: φ(z) at three times. Right: the waves in the (t, z) plane; each line carries
# one concentration. The lines leave a point and spread: that is the mixing.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf

scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=sf.Step(0.5))
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
sf.pictures.profiles(scene.solve([0, 0.2, 0.4], np.linspace(0, 1, 501)), left)
bed = scene.track(0.05)
bed.advance(0.5)
sf.pictures.fronts(bed, right)
