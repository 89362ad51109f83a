// SPDX-License-Identifier: Apache-2.0
// A .gltf or .glb file: what loads must pose.
#include <gnomon/scene.hpp>

#include "expected_error.hpp"
#include "input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t bytes) {
    using namespace gnomon;
    static const fuzz::InputFile file;
    fuzz::try_input(ErrorKind::input, [&] {
        const Scene scene = load_scene(file.path_with(data, bytes));
        pose_scene(scene, {AnimationChoice::Kind::all, 0}, 0.0, 0.5, 1);
    });
    return 0;
}
