#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the preset dev with its tests and runs them; the last line is "N passed, N failed, N skipped". Stage, layout and end-to-end tests
# run on the driver of tools/second_driver.sh as well.
# Usage: tools/test.sh [--no-install] [--long] [--driver FOLDER|ICD]
#   --no-install: take the packages, and the second driver, as they are
#   --long: the tests with the label "long" as well
#   --driver: everything on this Vulkan driver only, named by its ICD manifest or by a folder that has one or a libvulkan_lvp.so
set -euo pipefail
cd "$(dirname "$0")/.."

fail() {
  echo "test.sh: error: $1" >&2
  exit "${2:-1}"
}

install=yes
excluded=long
driver=
while [[ $# -gt 0 ]]; do
  case "$1" in
    --no-install) install=no ;;
    --long) excluded= ;;
    --driver) [[ -n ${2:-} ]] || fail "--driver needs a folder or an ICD manifest; see --help" 2; driver=$2; shift ;;
    -h | --help) sed -n '3,8s/^# //p' "$0"; exit 0 ;;
    *) fail "unknown option $1; see --help" 2 ;;
  esac
  shift
done

# The path of the ICD manifest of the driver that --driver names.
find_manifest() {
  if [[ -f $1 ]]; then
    realpath "$1"
    return
  fi
  [[ -d $1 ]] || fail "--driver: there is no $1"
  local found library
  mapfile -t found < <(grep --files-with-matches '"library_path"' "$1"/*.json 2> /dev/null)
  [[ ${#found[@]} -le 1 ]] || fail "--driver: $1 has ${#found[@]} ICD manifests; name one of them"
  if [[ ${#found[@]} -eq 1 ]]; then
    realpath "${found[0]}"
    return
  fi
  library=$(find "$1" -name libvulkan_lvp.so | head -n 1)
  [[ -n $library ]] || fail "--driver: $1 holds no driver, neither an ICD manifest (*.json) nor a libvulkan_lvp.so; tools/second_driver.sh unpacks one"
  mkdir -p build/dev
  echo "{ \"file_format_version\": \"1.0.0\", \"ICD\": { \"library_path\": \"$(realpath "$library")\", \"api_version\": \"1.3.0\" } }" \
    > build/dev/driver.json
  realpath build/dev/driver.json
}

caches=$PWD/build/dev/shader_caches
second=
if [[ -n $driver ]]; then
  manifest=$(find_manifest "$driver")
  excluded+=${excluded:+|}second_driver
  caches+=/driver_$(sha256sum "$manifest" | head -c 8)
  mkdir -p "$caches"
  # Loaders before 1.3.207 know the second name only.
  export VK_DRIVER_FILES=$manifest VK_ICD_FILENAMES=$manifest MESA_SHADER_CACHE_DIR=$caches/as_is
fi

[[ $install == no ]] || tools/install.sh
if [[ -z $driver ]]; then
  print=()
  [[ $install == yes ]] || print=(--print)
  second=$(tools/second_driver.sh "${print[@]}") || echo "test.sh: warning: no second driver: its tests are skipped" >&2
fi
cmake --preset dev -DGNOMON_SECOND_DRIVER="$second" -DGNOMON_SHADER_CACHES="$caches" > /dev/null
cmake --build --preset dev --parallel "$(nproc)"

# Says which driver a manifest is, or that it is none.
check_driver() {
  local devices
  devices=$(VK_DRIVER_FILES=$2 VK_ICD_FILENAMES=$2 build/dev/gnomon devices 2>&1) || fail "the driver of $2 does not load: $(tail -n 1 <<< "$devices")"
  echo "$1: $(sed -n 's/^\* *[0-9][0-9]*  *//p' <<< "$devices")"
}
[[ -z $driver ]] || check_driver "Driver" "$manifest"
[[ -z $second ]] || check_driver "Second driver" "$second"

labels=()
[[ -z $excluded ]] || labels=(--label-exclude "^($excluded)\$")
results=$PWD/build/dev/tests.xml
rm -f "$results"
code=0
ctest --preset dev --parallel "$(nproc)" "${labels[@]}" --output-junit "$results" || code=$?
[[ -s $results ]] || fail "ctest wrote no results, $results; see its messages above"

# One <testcase status="..."> line for each test. A test that could not be started is "notrun" as well as one that was skipped;
# only the latter names the rule that skipped it. Disabled tests count as skipped.
count() { grep --count --extended-regexp "$1" "$results" || true; }
total=$(count '<testcase ')
passed=$(count '<testcase .*status="run"')
skipped=$(($(count '<skipped message="SKIP_') + $(count '<testcase .*status="disabled"')))
failed=$((total - passed - skipped))
[[ $total -gt 0 ]] || fail "no tests were found"
[[ $failed -eq 0 || $code -ne 0 ]] || code=1
echo "$passed passed, $failed failed, $skipped skipped"
exit "$code"
