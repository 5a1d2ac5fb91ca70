#!/bin/sh
# Lays oil on a textured sheet in three ways and compares the friction that follows.
# Usage: run.sh [path to the tabor program]; writes lubricant.h5 into the current folder.
set -eu
tabor=${1:-tabor}
scan=$(dirname "$0")/../../surfaces/edt_before.x3p

"$tabor" lubricate "$scan" --level plane --density 0.45g/m^2,0.9g/m^2 -o lubricant.h5
"$tabor" lubricate "$scan" --level plane --density 0.45g/m^2,0.9g/m^2 --model limit

for model in droplets limit bottom-fill; do
  echo "$model:"
  "$tabor" friction "$scan" --level plane --mirror --pressure 7MPa --density 0.45g/m^2,0.9g/m^2 \
    --model "$model" --youngs-modulus 70GPa --poisson-ratio 0.33 --saturation-pressure 240MPa \
    --shear-strength 70MPa
done
