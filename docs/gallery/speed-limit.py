# A speed limit
# Cars meet a road on which half the speed is allowed: the jam grows backwards from it.
import shearfront as sf

road = sf.read("datasets/traffic-speed-limit/scene.toml")
bed = road.track(0.02)
bed.advance(1.5)
figure = sf.pictures.fronts(bed).figure
