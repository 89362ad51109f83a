// SPDX-License-Identifier: Apache-2.0
// When and where something is measured.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gnomon::timing {

using Json = nlohmann::ordered_json;

std::string utc_now();   ///< "2026-11-27T12:00:00Z"
std::string cpu_name();  ///< As the system calls it; empty where it does not say.
double cpu_mhz();        ///< Of the first core, now; 0 where the system does not say.
std::string host_name();
Json load_average();       ///< Over 1, 5 and 15 minutes; null where the system does not say.
const char* build_type();  ///< "release" or "debug"

}  // namespace gnomon::timing
