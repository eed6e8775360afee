# A flux of one's own
# Left: the law of this page (line) beside φ (φ - 1) (dashed). Right: its fronts; a fan can end in a shock now.
import matplotlib.pyplot as plt
import numpy as np

import shearfront as sf


def law(phi):
    return -phi * (1 - phi) * (1 - 0.6 * phi) ** 2


flux = sf.sampled(law, kind="flux", tolerance=1e-6)
scene = sf.Scene(flux=flux.model, shear_rate=sf.Piecewise([0.29], [2.4, 0.31]), initial=sf.Step(0.5))
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.8), layout="constrained", width_ratios=(1, 1.6))
phi = np.linspace(0, 1, 201)
left.plot(phi, law(phi), color=sf.pictures.COLOURS[0])
left.plot(phi, phi * (phi - 1), "--", color="grey")
left.set(xlabel="φ", ylabel="f(φ)")
bed = scene.track(0.04)
bed.advance(np.inf)
sf.pictures.fronts(bed, right)
