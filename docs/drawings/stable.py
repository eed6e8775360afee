# The two orders
# Left: small above large, a fan opens, the bed mixes and then segregates. Right: a mixture above small grains, large grains
# above a mixture: only shocks, they bring the pure states.
import matplotlib.pyplot as plt

import shearfront as sf

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.8), layout="constrained")
for ax, initial in ((left, sf.Step(0.5)), (right, sf.Pieces([0.3, 0.7], [1, 0.5, 0]))):
    scene = sf.Scene(shear_rate=sf.Piecewise([], [1]), initial=initial)
    bed = scene.track(0.04)
    bed.advance(float("inf"))
    sf.pictures.fronts(bed, ax, events=scene.events())
    ax.set_xlim(0, 2.1)
