# A block of large grains
# Large grains (dark) start in a block at the bottom of a flow down a slope. The flow shears it, they rise through the small ones, and in the end lie on top
# everywhere: frames of a periodic slab φ(x, z, t).
shearfront solve datasets/basilisk-slab/scene.toml --times 0,0.25,0.5,0.75,1,1.5,2,4 --positions 0.5 --heights 0.5 \
  --method slab --cells 128 --map picture.svg -o film.csv
