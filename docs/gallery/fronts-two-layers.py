# Two layers: every wave front
# The shear cell of May, Shearer and Daniels (2010): large grains start below z = 0.5, small ones above. Thin lines belong to
# the fan in which the bed mixes, thick ones are the shocks in which it segregates.
import shearfront as sf

scene = sf.read("datasets/may-2010-piecewise/scene.toml")
bed = scene.track(0.02)
bed.advance(float("inf"))
figure = sf.pictures.fronts(bed, events=scene.events()).figure
