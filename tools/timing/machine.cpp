// SPDX-License-Identifier: Apache-2.0
#include "timing/machine.hpp"

#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fstream>

namespace gnomon::timing {
namespace {

// Of the first core; empty where there is no such member.
std::string cpu_info(const std::string& member) {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(": ");
        if (line.starts_with(member) && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "";
}

}  // namespace

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

std::string cpu_name() { return cpu_info("model name"); }

double cpu_mhz() { return std::strtod(cpu_info("cpu MHz").c_str(), nullptr); }

std::string host_name() {
    char name[256] = {};
    return gethostname(name, sizeof(name) - 1) == 0 ? name : "";
}

Json load_average() {
    double loads[3] = {};
    const int count = getloadavg(loads, 3);
    return count == 3 ? Json{loads[0], loads[1], loads[2]} : Json(nullptr);
}

const char* build_type() {
#ifdef NDEBUG
    return "release";
#else
    return "debug";
#endif
}

}  // namespace gnomon::timing
