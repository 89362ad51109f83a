#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Fuzz: tools/fuzz.sh RUNS [TARGET...] builds the targets of tests/fuzz with libFuzzer (Clang) and runs each, or those named, so many
# times, one after the other. What they find new is kept in build/fuzz/corpus and used again; an input that ends badly is written to
# build/fuzz/crashes, and the exit code is 1.
set -u
cd "$(dirname "$0")/.." || exit 1
runs=${1:?"runs are missing: tools/fuzz.sh RUNS [TARGET...]"}
shift
[ $# -gt 0 ] || set -- json scene image exr layout render_json command_line
build=build/fuzz
cmake --preset fuzz && cmake --build --preset fuzz || exit 1
$build/fuzz_seeds $build/seeds || exit 1
mkdir -p $build/crashes
failed=0
for target in "$@"; do
  mkdir -p $build/corpus/$target
  dictionary=
  [ ! -e $build/seeds/$target.dict ] || dictionary=-dict=$build/seeds/$target.dict
  # Bounds: what a small file may take, in memory (MiB) and time (s).
  $build/fuzz_$target -runs="$runs" -max_len=8192 -timeout=20 -rss_limit_mb=3072 -malloc_limit_mb=2048 -print_final_stats=1 \
    $dictionary -artifact_prefix=$build/crashes/$target- $build/corpus/$target $build/seeds/$target 2> $build/$target.log
  result=$?
  [ $result -eq 0 ] || failed=1
  printf '%s: %s runs, exit code %s, %s/%s.log\n' "$target" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' $build/$target.log)" "$result" $build "$target"
done
exit $failed
