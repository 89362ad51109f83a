// SPDX-License-Identifier: Apache-2.0
// Prints the hash of a frame, as gnomon compare --hash does of its file, for tests that need a process of their own: frame_hash
// SCENE WIDTH HEIGHT SPP SHADOW_RES LAYOUT [METHOD].
#include <cstdlib>
#include <iostream>

#include "io/image_hash.hpp"
#include "test_scenes.hpp"

int main(int argc, char** argv) {
    using namespace gnomon;
    if (argc != 7 && argc != 8) return 2;
    try {
        const test::PosedScene posed = test::load_posed(argv[1]);
        const auto number = [&](int i) { return static_cast<uint32_t>(std::strtoul(argv[i], nullptr, 10)); };
        RenderSettings settings;
        settings.width = number(2);
        settings.height = number(3);
        settings.spp = number(4);
        settings.shadow_res = number(5);
        settings.layout = argv[6];
        if (argc == 8) settings.method = argv[7];
        if (settings.method == "accumulate") settings.parameters["slices"] = settings.spp;
        const Frame frame = test::shared_renderer().render(posed.scene, posed.poses, settings);
        std::cout << io::hash_text(test::hash_of(frame));
    } catch (const std::exception& error) {
        std::cerr << error.what() << std::endl;
        return 1;
    }
}
