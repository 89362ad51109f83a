// SPDX-License-Identifier: Apache-2.0
// Reads the environment variable GNOMON_LIMITS.
#include "gpu/limits.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <gnomon/error.hpp>
#include <set>
#include <sstream>

namespace gnomon::gpu {
namespace {

struct KnownLimit {
    std::string name;
    uint64_t own;
    std::function<void(uint64_t)> set;
};

template <class T>
KnownLimit known(const char* name, T& value) {
    return {name, static_cast<uint64_t>(value), [&value](uint64_t lowered) { value = static_cast<T>(lowered); }};
}

std::vector<KnownLimit> known_limits(Limits& limits) {
    return {known("buffer", limits.max_buffer_bytes),
            known("crew", limits.crew),
            known("dispatch_ms", limits.dispatch_ms),
            known("groups", limits.max_groups),
            known("mapped", limits.mapped),
            known("push_constants", limits.push_constant_bytes),
            known("storage_buffers", limits.storage_buffers),
            known("storage_range", limits.max_storage_range),
            known("texel_reads", limits.texel_reads),
            known("texels", limits.max_texels),
            known("timestamps", limits.timestamps)};
}

[[noreturn]] void fail(const std::vector<KnownLimit>& limits, const std::string& part, const std::string& what) {
    std::string names;
    for (const KnownLimit& limit : limits) {
        names += (names.empty() ? "" : ", ") + limit.name + " (" + std::to_string(limit.own) + ")";
    }
    throw Error(ErrorKind::usage, "'" + part + "' " + what, "environment variable GNOMON_LIMITS",
                "give NAME=VALUE,... of these, none above the device's own: " + names);
}

}  // namespace

Limits lower_limits(Limits own, const std::string& text) {
    Limits lowered = own;
    const std::vector<KnownLimit> limits = known_limits(lowered);
    std::set<std::string> seen;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) {
        const std::string name = part.substr(0, part.find('='));
        const auto limit = std::find_if(limits.begin(), limits.end(), [&](const KnownLimit& l) { return l.name == name; });
        if (limit == limits.end()) fail(limits, part, "is not a limit");
        if (!seen.insert(name).second) fail(limits, part, "is given twice");
        const char* begin = part.data() + std::min(part.size(), name.size() + 1);
        const char* end = part.data() + part.size();
        uint64_t value = 0;
        const auto read = std::from_chars(begin, end, value);
        if (begin == end || read.ec != std::errc() || read.ptr != end) fail(limits, part, "is not a number");
        if (value > limit->own) fail(limits, part, "is above the device's own " + std::to_string(limit->own));
        limit->set(value);
    }
    return lowered;
}

}  // namespace gnomon::gpu
