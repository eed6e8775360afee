# Oil and water
# Water pushes oil out of a rock (Buckley and Leverett): a shock with a fan behind it, which no flux that bends one way can
# have.
import numpy as np

import shearfront as sf

rock = sf.Scene(
    flux=sf.BuckleyLeverett(1),
    shear_rate=sf.Piecewise([], [1]),
    initial=sf.Pieces([], [0]),
    boundary={"bottom": {"values": [1]}, "top": {"values": [0]}},
)
solution = rock.solve([0.1, 0.3, 0.5, 0.7], np.linspace(0, 1, 801), method="front-tracking", resolution=0.002)
ax = sf.pictures.profiles(solution)
ax.set_xlabel("share of water")
figure = ax.figure
