#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds gnomon and renders a first picture, out/figure.png. What is up to date is not made again.
# Usage: tools/quickstart.sh [--no-install]     --no-install: take the packages as they are
set -euo pipefail
cd "$(dirname "$0")/.."

install=yes
for argument in "$@"; do
  case "$argument" in
    --no-install) install=no ;;
    -h | --help) sed -n '3,4s/^# //p' "$0"; exit 0 ;;
    *) echo "quickstart.sh: error: unknown option $argument; see --help" >&2; exit 2 ;;
  esac
done

[[ $install == no ]] || tools/install.sh
cmake --preset release > /dev/null
cmake --build --preset release --parallel "$(nproc)" --target gnomon

gnomon=build/release/gnomon
scene=scenes/figure.gltf
picture=out/figure.png
if [[ ! $picture -nt $gnomon || ! $picture -nt $scene || ! $picture -nt ${scene%.gltf}.bin ]]; then
  mkdir -p out
  "$gnomon" render "$scene" -o "${picture%.png}.exr" --png "$picture" --size 1280x720 --spp 16
fi
echo "The picture: $PWD/$picture (8 bit), $PWD/${picture%.png}.exr (all channels)"
