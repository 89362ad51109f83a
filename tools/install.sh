#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the packages of Debian 12, Debian 13 or Ubuntu 24.04 that building and testing gnomon needs; does nothing where they are there.
# Usage: tools/install.sh [--dev]     --dev: clang-format and clang-tidy as well
set -euo pipefail

packages=(
  cmake ninja-build g++ git pkg-config
  libvulkan-dev vulkan-validationlayers mesa-vulkan-drivers glslang-tools glslang-dev spirv-headers
  libglm-dev libtinygltf-dev libstb-dev nlohmann-json3-dev
  libopenexr-dev libpng-dev
  libspdlog-dev libcli11-dev
  libgtest-dev libgmock-dev libembree-dev
)
formatter=clang-format-14

# What differs between the releases.
release=$(sed -n "s/^VERSION_CODENAME=//p" /etc/os-release 2> /dev/null || true)
case "$release" in
  bookworm) formatter=clang-format ;;
  trixie)
    packages+=(libdisplay-info2) # Mesa of trixie-backports, for tools/second_driver.sh.
    formatter=clang-format       # Not version 14, which trixie does not have.
    ;;
esac

fail() {
  echo "install.sh: error: $1" >&2
  exit 1
}

for argument in "$@"; do
  case "$argument" in
    --dev) packages+=("$formatter" clang-tidy) ;;
    -h | --help) sed -n '3,4s/^# //p' "$0"; exit 0 ;;
    *) fail "unknown option $argument; see --help" ;;
  esac
done

command -v dpkg-query > /dev/null || fail "this is not a Debian system; install the counterparts of: ${packages[*]}"

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2> /dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

command -v apt-get > /dev/null || fail "apt-get not found; install these packages by hand: ${missing[*]}"
as_root=()
if [[ $EUID -ne 0 ]]; then
  command -v sudo > /dev/null || fail "not root and no sudo; as root, run: apt-get install ${missing[*]}"
  as_root=(sudo)
fi

echo "Installing: ${missing[*]}" >&2
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes --no-install-recommends \
    -o Acquire::Retries=3 -o APT::Update::Error-Mode=any "$@" >&2
}
apt update || fail "apt-get update failed; check the network and the apt sources, or install by hand: ${missing[*]}"
apt install "${missing[@]}" || fail "apt-get install failed (see above); gnomon is built on Debian 12, Debian 13 and Ubuntu 24.04: ${missing[*]}"
