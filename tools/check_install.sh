#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs a built preset into a temporary folder and builds and runs a program of its own against it.
# Usage: tools/check_install.sh [PRESET]     PRESET: release unless given
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}

folder=$(mktemp --directory)
trap 'rm -rf "$folder"' EXIT
cmake --preset "$preset" > /dev/null
cmake --build --preset "$preset" --parallel "$(nproc)" --target gnomon
cmake --install "build/$preset" --prefix "$folder/prefix" > /dev/null

mkdir "$folder/user"
cat > "$folder/user/CMakeLists.txt" << 'END'
cmake_minimum_required(VERSION 3.25)
project(user LANGUAGES CXX)
find_package(gnomon REQUIRED)
add_executable(user user.cpp)
target_link_libraries(user PRIVATE gnomon::pipeline)
END
cat > "$folder/user/user.cpp" << 'END'
#include <cstdio>
#include <gnomon/render.hpp>
#include <gnomon/scene.hpp>
#include <gnomon/version.hpp>

int main(int, char** arguments) {
    const gnomon::Scene scene = gnomon::load_scene(arguments[1]);
    const auto poses = gnomon::pose_scene(scene, gnomon::choose_animation(scene, "0"), 0.0, 1.0 / 48.0, 1);
    gnomon::RenderSettings settings;
    settings.width = 64;
    settings.height = 36;
    settings.spp = 1;
    const gnomon::Frame frame = gnomon::Renderer().render(scene, poses, settings);
    std::printf("%zu triangles, %zu channels, on %s\n", scene.triangles.size(), frame.channels.size(), frame.stats.device.c_str());
    return frame.channels.size() >= 5 ? 0 : 1;
}
END
cmake -S "$folder/user" -B "$folder/user/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$folder/prefix" > /dev/null
cmake --build "$folder/user/build"
"$folder/user/build/user" scenes/two-cubes.gltf
"$folder/prefix/bin/gnomon" --version
