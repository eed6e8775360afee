# A steady chute
# Small grains flow in above large ones, sheared as u = 2 z: fronts over the distance x, straight in the flow below them and bent in z.
shearfront solve datasets/chute-steady-shear/scene-unmixed.toml --times steady --heights 0.5 --method front-tracking --resolution 0.02 \
  --fronts fronts.csv --plot picture.svg -o samples.csv
