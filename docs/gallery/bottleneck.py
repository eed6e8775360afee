# A bottleneck
# A uniform mixture over a layer that is sheared little: no more than its capacity passes, the rest piles up. Exact solution.
import shearfront as sf

scene = sf.read("datasets/bottleneck/scene.toml")
figure = sf.pictures.map(scene, 1.02 * scene.events().t_star).figure
