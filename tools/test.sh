#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the preset dev with its tests and runs them; the last line is "N passed, N failed, N skipped".
# Usage: tools/test.sh [--no-install] [--long]     --long: the tests with the label "long" as well
set -euo pipefail
cd "$(dirname "$0")/.."

install=yes
labels=(--label-exclude '^long$')
for argument in "$@"; do
  case "$argument" in
    --no-install) install=no ;;
    --long) labels=() ;;
    -h | --help) sed -n '3,4s/^# //p' "$0"; exit 0 ;;
    *) echo "test.sh: error: unknown option $argument; see --help" >&2; exit 2 ;;
  esac
done

[[ $install == no ]] || tools/install.sh
cmake --preset dev > /dev/null
cmake --build --preset dev --parallel "$(nproc)"

results=$PWD/build/dev/tests.xml
rm -f "$results"
code=0
ctest --preset dev --parallel "$(nproc)" "${labels[@]}" --output-junit "$results" || code=$?
if [[ ! -s $results ]]; then
  echo "test.sh: error: ctest wrote no results, $results; see its messages above" >&2
  exit 1
fi

# One <testcase status="..."> line for each test. A test that could not be started is "notrun" as well as one that was skipped;
# only the latter names the rule that skipped it. Disabled tests count as skipped.
count() { grep --count --extended-regexp "$1" "$results" || true; }
total=$(count '<testcase ')
passed=$(count '<testcase .*status="run"')
skipped=$(($(count '<skipped message="SKIP_') + $(count '<testcase .*status="disabled"')))
failed=$((total - passed - skipped))
if [[ $total -eq 0 ]]; then
  echo "test.sh: error: no tests were found" >&2
  exit 1
fi
[[ $failed -eq 0 || $code -ne 0 ]] || code=1
echo "$passed passed, $failed failed, $skipped skipped"
exit "$code"
