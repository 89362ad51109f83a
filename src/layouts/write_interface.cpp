// SPDX-License-Identifier: Apache-2.0
// For the build: write_interface MANIFEST FILE writes the GLSL that a layout's manifest stands for.
#include <fstream>
#include <iostream>

#include "layouts/interface.hpp"
#include "text/read_text.hpp"

int main(int argc, char** argv) {
    using namespace gnomon;
    if (argc != 3) return 2;
    try {
        std::string reason;
        const std::optional<std::string> manifest = read_text(argv[1], reason);
        if (!manifest) throw std::runtime_error(std::string(argv[1]) + ": " + reason);
        std::ofstream(argv[2]) << layout_interface(parse_layout(*manifest, argv[1]));
    } catch (const std::exception& error) {
        std::cerr << error.what() << std::endl;
        return 1;
    }
}
