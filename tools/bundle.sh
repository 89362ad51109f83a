#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Packs gnomon for machines without its packages: one tar file with the commands, their libraries, the Vulkan loader and scenes. It runs on
# x86-64 Linux with a Vulkan driver and a glibc at least as new as this system's: made on Debian 12, from there on. There, unpack it and
# run bundle/run (bundle/run --help) or bundle/bin/gnomon.
# Usage: tools/bundle.sh [--tests] [FILE]
#   --tests: with the tests and the validation layer that they use
#   FILE: build/bundle.tar.xz unless given
set -euo pipefail
cd "$(dirname "$0")/.."

fail() {
  echo "bundle.sh: error: $1" >&2
  exit "${2:-1}"
}

tests=no
file=build/bundle.tar.xz
for argument in "$@"; do
  case "$argument" in
    --tests) tests=yes ;;
    -h | --help) sed -n '3,8s/^# //p' "$0"; exit 0 ;;
    -*) fail "unknown option $argument; see --help" 2 ;;
    *) file=$argument ;;
  esac
done
[[ -d $(dirname "$file") || $file == build/* ]] || fail "there is no folder $(dirname "$file") to write $(basename "$file") to" 3

# In a folder of its own: the benchmark's peer is built for this processor otherwise.
build=build/bundle
cmake --preset release -B "$build" -DGNOMON_PEER_NATIVE=OFF > /dev/null
commands=(gnomon reference make_scenes frame_bench)
targets=("${commands[@]}")
[[ $tests == no ]] || targets=(all)
cmake --build "$build" --parallel "$(nproc)" --target "${targets[@]}"
programs=("${commands[@]}")
[[ $tests == no ]] || mapfile -t -O "${#programs[@]}" programs < <(cd "$build" && find . -maxdepth 1 -type f \( -name '*_test' -o -name frame_hash \) -printf '%f\n' | sort)

stage=$(mktemp --directory)
trap 'rm -rf "$stage"' EXIT
root=$stage/bundle
mkdir -p "$root"/{bin,libexec,lib/shared}
cp tools/bundle/run tools/bundle/launch LICENSE "$root"
cp -r scenes "$root"

for program in "${programs[@]}"; do
  strip -o "$root/libexec/$program" "$build/$program"
  ln -s ../launch "$root/bin/$program"
done
if [[ $tests == yes ]]; then
  cp -r comp_shaders "$root"
  mkdir "$root/layer"
  manifest=/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json
  layer=$(ldconfig -p | sed -n 's/.*libVkLayer_khronos_validation\.so .* => //p')
  [[ -n $layer ]] || layer=$(dpkg -L vulkan-validationlayers | grep '/libVkLayer_khronos_validation\.so$') \
    || fail "no validation layer; run tools/install.sh"
  cp "$layer" "$root/layer"
  # Relative to the manifest.
  sed 's|"library_path": *"[^"]*"|"library_path": "./libVkLayer_khronos_validation.so"|' "$manifest" > "$root/layer/$(basename "$manifest")"
fi

# What the programs load, but for glibc. What a driver may load as well goes to lib/shared: launch takes the newer, the system's or ours.
loaded=$(ldd "$root"/libexec/* "$root"/layer/*.so 2> /dev/null || ldd "$root"/libexec/*)
lacks=$(grep 'not found' <<< "$loaded" || true)
[[ -z $lacks ]] || fail "libraries are missing here: $(head -n 1 <<< "$lacks" | xargs); run tools/install.sh"
while read -r library; do
  name=$(basename "$library")
  folder=$root/lib
  case "$name" in
    libc.so.* | libm.so.* | libpthread.so.* | libdl.so.* | librt.so.* | ld-linux*) continue ;;
    libstdc++.so.* | libgcc_s.so.*) folder=$root/lib/shared/libstdc++.so.6 ;; # One compiler's, together.
    libvulkan.so.* | libz.so.* | libpng*.so.*) folder=$root/lib/shared/$name ;;
  esac
  mkdir -p "$folder"
  real=$(realpath "$library")
  cp "$real" "$folder"
  [[ $(basename "$real") == "$name" ]] || ln -s "$(basename "$real")" "$folder/$name"
done < <(awk '$2 == "=>" {print $3}' <<< "$loaded" | sort -u)

git describe --always --dirty > "$root/version" 2> /dev/null || echo unknown > "$root/version"
mkdir -p "$(dirname "$file")"
tar -C "$stage" -cf - bundle | xz --threads=0 > "$file.new"
mv "$file.new" "$file"
glibc=$(find "$root" -type f \( -path '*/libexec/*' -o -name '*.so*' \) -exec objdump -T {} + 2> /dev/null | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -n 1)
echo "$file: $(du -h "$file" | cut -f 1), for glibc ${glibc#GLIBC_} or newer"
