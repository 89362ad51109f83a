#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Unpacks lavapipe of Debian's backports to FOLDER/mesa-VERSION and prints the path of its ICD manifest, for VK_DRIVER_FILES. Installs
# nothing; what is there is taken as it is.
# Usage: tools/second_driver.sh [--print] [FOLDER]     FOLDER: build/drivers unless given; --print: only say which is there
set -euo pipefail
cd "$(dirname "$0")/.."

fail() {
  echo "second_driver.sh: error: $1" >&2
  exit 1
}

unpack=yes
folder=build/drivers
for argument in "$@"; do
  case "$argument" in
    --print) unpack=no ;;
    -h | --help) sed -n '3,5s/^# //p' "$0"; exit 0 ;;
    -*) echo "second_driver.sh: error: unknown option $argument; see --help" >&2; exit 2 ;;
    *) folder=$argument ;;
  esac
done

# The newest that is there. A manifest is written last, so its driver is whole; it names the driver by an absolute path, so a folder that
# was moved is unpacked again.
manifest=$(find "$folder" -mindepth 2 -maxdepth 2 -path '*/mesa-*/icd.json' 2> /dev/null | sort --version-sort | tail -n 1 || true)
if [[ -n $manifest ]] && grep --quiet --fixed-strings "\"$(realpath "${manifest%/*}")/libvulkan_lvp.so\"" "$manifest"; then
  realpath "$manifest"
  exit 0
fi
[[ $unpack == yes ]] || fail "no driver in $folder; run tools/second_driver.sh with a network"

read_release() { sed -n "s/^$1=//p" /etc/os-release 2> /dev/null; }
[[ $(read_release ID) == debian ]] \
  || fail "only Debian's backports have this driver: unpack a Mesa by hand, and name its ICD by tools/test.sh --driver"
backports=$(read_release VERSION_CODENAME)-backports
keys=/usr/share/keyrings/debian-archive-keyring.gpg
for command in apt-get dpkg-deb; do
  command -v "$command" > /dev/null || fail "$command not found; unpack a Mesa by hand, and name its ICD by tools/test.sh --driver"
done
[[ -r $keys ]] || fail "$keys not found; install the package debian-archive-keyring"

# apt with one source and state of its own; what the system has and where it gets it from stay as they are.
mkdir -p "$folder"
work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
mkdir -p "$work/lists/partial" "$work/cache/archives/partial"
echo "deb [signed-by=$keys] http://deb.debian.org/debian $backports main" > "$work/sources.list"
apt() {
  apt-get --quiet=2 -o Dir::Etc::sourcelist="$work/sources.list" -o Dir::Etc::sourceparts=- -o Dir::State::lists="$work/lists" \
    -o Dir::Cache="$work/cache" -o APT::Sandbox::User=root -o Acquire::Retries=3 -o APT::Update::Error-Mode=any "$@" >&2
}
echo "Unpacking mesa-vulkan-drivers of $backports" >&2
apt update || fail "cannot read $backports of deb.debian.org; check the network, or name a driver that you have by tools/test.sh --driver"
(cd "$work" && apt download "mesa-vulkan-drivers/$backports") || fail "cannot download mesa-vulkan-drivers of $backports; see above"
package=$(find "$work" -maxdepth 1 -name '*.deb')
version=$(dpkg-deb --field "$package" Version)
version=${version#*:}
dpkg-deb --extract "$package" "$work/root"
driver=$(find "$work/root/usr/lib" -name libvulkan_lvp.so)
[[ -n $driver ]] || fail "mesa-vulkan-drivers $version has no libvulkan_lvp.so"

# It needs little but what the release's own mesa-vulkan-drivers needs, LLVM among it; tools/install.sh installs all of that.
lacks=$(ldd -r "$driver" 2>&1 | grep -E 'not found|undefined symbol' || true)
[[ -z $lacks ]] || fail "lavapipe $version lacks libraries of the system ($(head -n 1 <<< "$lacks" | xargs)); run tools/install.sh"

target=$folder/mesa-${version%%-*}
mkdir -p "$target"
cp "$driver" "$target"
echo "$version" > "$target/version"
sed "s|\"library_path\": *\"[^\"]*\"|\"library_path\": \"$(realpath "$target")/libvulkan_lvp.so\"|" "$work"/root/usr/share/vulkan/icd.d/lvp*.json \
  > "$work/icd.json"
mv "$work/icd.json" "$target/icd.json"
realpath "$target/icd.json"
