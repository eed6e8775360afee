# Curved fronts
# Where a(z) falls smoothly, as in a shear cell with a(z) = 6.7 exp(-z / 0.16), fronts are curved. They are followed as they
# are, not as a staircase.
import shearfront as sf

scene = sf.read("datasets/may-2010-exponential/scene.toml")
bed = scene.track(0.04)
bed.advance(float("inf"))
figure = sf.pictures.fronts(bed, events=scene.events()).figure
