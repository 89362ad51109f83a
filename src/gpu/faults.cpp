// SPDX-License-Identifier: Apache-2.0
// A fault's evidence is in ARCHITECTURE.md, "Rules", or where it is avoided.
#include "gpu/faults.hpp"

#include <array>
#include <cstdio>

namespace gnomon::gpu {
namespace {

using Version = std::array<int, 3>;

constexpr Version kNoneKnown{};

struct Fault {
    VkDriverId driver;
    Version gone;  ///< The first version that was seen without it.
    const char* text;
};

constexpr Fault kFaults[] = {
    {VK_DRIVER_ID_MESA_LLVMPIPE, Version{25, 0, 7},
     "ends an invocation's loops after 65,535 turns, without a word; longer lists take several dispatches"},
    {VK_DRIVER_ID_MESA_LLVMPIPE, kNoneKnown,
     "values made in a loop that invocations leave at different turns may be wrong behind it (seen on Mesa 22.3.6); such loops "
     "are tested at their top"},
    {VK_DRIVER_ID_MESA_LLVMPIPE, kNoneKnown,
     "an indirect dispatch begins where the dispatch before it did (seen on Mesa 22.3.6); an empty one goes before it"},
    {VK_DRIVER_ID_MESA_LLVMPIPE, kNoneKnown,
     "its cache gives code for one LP_NATIVE_VECTOR_WIDTH to another (seen on Mesa 22.3.6 and 25.0.7); give each width a "
     "MESA_SHADER_CACHE_DIR of its own"},
    {VK_DRIVER_ID_NVIDIA_PROPRIETARY, kNoneKnown,
     "is no longer found after some thirty loads in a process (seen on 580); it is kept loaded"},
};

// {22, 3, 6} of "Mesa 22.3.6 (LLVM 15.0.6)"; all 0 where there is no such number.
Version mesa_version(const std::string& text) {
    Version version{};
    std::sscanf(text.c_str(), "Mesa %d.%d.%d", &version[0], &version[1], &version[2]);
    return version;
}

}  // namespace

std::vector<std::string> faults_of(VkDriverId driver, const std::string& version) {
    std::vector<std::string> faults;
    for (const Fault& fault : kFaults) {
        const bool gone = fault.gone != kNoneKnown && mesa_version(version) >= fault.gone;
        if (fault.driver == driver && !gone) faults.emplace_back(fault.text);
    }
    return faults;
}

}  // namespace gnomon::gpu
