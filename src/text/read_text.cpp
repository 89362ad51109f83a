// SPDX-License-Identifier: Apache-2.0
#include "text/read_text.hpp"

#include <cstdint>
#include <fstream>
#include <system_error>

namespace gnomon {

namespace fs = std::filesystem;

std::optional<std::string> read_text(const fs::path& path, std::string& reason) {
    constexpr uint64_t kMostBytes = uint64_t{64} << 20;
    const auto refuse = [&](const std::string& why) {
        reason = why;
        return std::nullopt;
    };
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) return refuse("there is no such file");
    if (!fs::is_regular_file(status)) return refuse("it is not a regular file");
    const uint64_t bytes = fs::file_size(path, error);
    if (!error && bytes > kMostBytes) return refuse("it has more than " + std::to_string(kMostBytes >> 20) + " MiB");
    std::ifstream file(path, std::ios::binary);
    if (error || !file) return refuse("it cannot be opened");
    std::string text(bytes, '\0');
    file.read(text.data(), static_cast<std::streamsize>(bytes));
    if (!file) return refuse("it cannot be read");
    return text;
}

}  // namespace gnomon
