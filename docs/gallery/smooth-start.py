# A smooth start
# φ(z, 0) as a sine: where it rises it spreads, where it falls it steepens until it breaks.
import shearfront as sf

scene = sf.Scene(
    shear_rate=sf.Exponential(2, 0.7),
    initial=sf.SineInitial(mean=0.5, amplitude=0.4, wavelength=0.7),
)
figure = sf.pictures.map(scene, 2, method="front-tracking", resolution=0.005).figure
