// SPDX-License-Identifier: Apache-2.0
// Bytes of a glTF scene.
#include "scene/gltf_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <span>
#include <system_error>

#include "text/percent_decoded.hpp"

namespace gnomon::gltf {

namespace fs = std::filesystem;

namespace {

constexpr uint32_t kGlbMagic = 0x46546c67;  // "glTF"
constexpr uint32_t kChunkJson = 0x4e4f534a;
constexpr uint32_t kChunkBinary = 0x004e4942;
constexpr uint64_t kGlbHeaderBytes = 12;
constexpr uint64_t kChunkHeaderBytes = 8;

[[noreturn]] void fail(const std::string& what, const std::string& where,
                       const std::string& hint = "repair or export the file again") {
    throw Error(ErrorKind::input, what, where, hint);
}

// A regular file of known size, read front to back.
class InputFile {
public:
    InputFile(const fs::path& path, const std::string& where) : where_(where) {
        std::error_code code;
        const fs::file_status status = fs::status(path, code);
        if (!fs::exists(status)) fail("the file '" + path.string() + "' does not exist", where, "check its name");
        if (!fs::is_regular_file(status)) fail("'" + path.string() + "' is not a regular file", where, "name a file");
        size_ = fs::file_size(path, code);
        stream_.open(path, std::ios::binary);
        if (code || !stream_) fail("the file '" + path.string() + "' cannot be opened", where, "check its permissions");
    }

    uint64_t size() const { return size_; }
    uint64_t rest() const { return size_ - position_; }

    void read(void* to, uint64_t bytes) {
        if (bytes > rest()) fail("the file ends too early", where_);
        stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
        if (!stream_) fail("the file cannot be read", where_, "check the disk and its permissions");
        position_ += bytes;
    }

    uint32_t read_u32() {
        std::array<uint8_t, 4> b{};
        read(b.data(), b.size());
        return b[0] | uint32_t{b[1]} << 8 | uint32_t{b[2]} << 16 | uint32_t{b[3]} << 24;
    }

    void rewind() {
        stream_.seekg(0);
        position_ = 0;
    }

private:
    std::string where_;
    std::ifstream stream_;
    uint64_t size_ = 0;
    uint64_t position_ = 0;
};

void read_json_text(InputFile& file, uint64_t bytes, SceneFile& scene) {
    if (bytes > kMaxJsonBytes) {
        fail("the JSON text has more than " + std::to_string(kMaxJsonBytes >> 20) + " MiB", scene.name,
             "keep buffers and images in files of their own");
    }
    scene.json.resize(bytes);
    file.read(scene.json.data(), bytes);
}

void read_glb(InputFile& file, SceneFile& scene, std::vector<std::string>& warnings) {
    const uint32_t version = file.read_u32();
    if (version != 2)
        fail("GLB version " + std::to_string(version) + " is not supported", scene.name, "convert it to glTF 2.0");
    const uint64_t length = file.read_u32();
    if (length > file.size() || length < kGlbHeaderBytes + kChunkHeaderBytes) {
        fail("the GLB header states " + std::to_string(length) + " bytes, the file has " + std::to_string(file.size()),
             scene.name);
    }
    if (length < file.size()) {
        warnings.push_back(std::to_string(file.size() - length) + " bytes behind the end of the GLB are ignored");
    }
    scene.is_glb = true;
    uint64_t position = kGlbHeaderBytes;
    for (int chunk = 0; position < length; ++chunk) {
        if (length - position < kChunkHeaderBytes) fail("a GLB chunk header is cut off", scene.name);
        const uint64_t bytes = file.read_u32();
        const uint32_t type = file.read_u32();
        position += kChunkHeaderBytes;
        if (bytes > length - position) {
            fail("GLB chunk " + std::to_string(chunk) + " states " + std::to_string(bytes) + " bytes, " +
                     std::to_string(length - position) + " are left",
                 scene.name);
        }
        position += bytes;
        if ((chunk == 0) != (type == kChunkJson)) fail("a GLB must have one JSON chunk, and it must be the first", scene.name);
        if (chunk == 0) {
            read_json_text(file, bytes, scene);
        } else if (type == kChunkBinary) {
            if (scene.has_binary) fail("the GLB has more than one BIN chunk", scene.name);
            if (bytes > kMaxBufferBytes) fail("the BIN chunk has more than 1 GiB", scene.name, "split the scene");
            scene.has_binary = true;
            scene.binary.resize(bytes);
            file.read(scene.binary.data(), bytes);
        } else {
            fail("GLB chunk " + std::to_string(chunk) + " has an unknown type", scene.name);
        }
    }
}

std::string decoded(std::string_view text, const Cursor& uri) {
    std::optional<std::string> result = percent_decoded(text);
    if (!result) uri.fail("'%' is not followed by two hexadecimal digits", "write a plain '%' as %25");
    return std::move(*result);
}

bool has_scheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon == 0) return false;
    return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                       [](unsigned char c) { return std::isalnum(c) != 0 || c == '+' || c == '.' || c == '-'; });
}

// The file that a relative address names. Nothing outside the folder is ever looked at, by whatever way.
fs::path resolve(const fs::path& folder, const Cursor& uri) {
    const std::string& text = uri.string();
    const std::string stay_inside = "files must lie in the scene's own folder and be named relative to it";
    if (has_scheme(text)) uri.fail("the address '" + text.substr(0, 80) + "' is not a file name", stay_inside);
    const fs::path relative = decoded(text, uri);
    if (relative.empty()) uri.fail("the address is empty", "name a file");
    if (relative.native().find('\0') != std::string::npos) uri.fail("the address holds a zero character", "name a file");
    if (relative.is_absolute()) uri.fail("the address '" + text + "' is an absolute path", stay_inside);
    if (std::find(relative.begin(), relative.end(), "..") != relative.end()) {
        uri.fail("the address '" + text + "' leaves the scene's folder", stay_inside);
    }
    std::error_code code;
    fs::path path = fs::canonical(folder / relative, code);
    if (code) uri.fail("the file '" + text + "' cannot be found", "put it into the scene's folder");
    if (std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first != folder.end()) {
        uri.fail("the address '" + text + "' leads out of the scene's folder by a link", stay_inside);
    }
    return path;
}

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    if (c == '/') return 63;
    return -1;
}

std::vector<uint8_t> base64_decoded(std::string_view text, const Cursor& uri) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) uri.fail("the base64 data are cut off");
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() * 3 / 4);
    uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) uri.fail("the base64 data hold an invalid character");
        bits = bits << 6 | static_cast<uint32_t>(digit);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(static_cast<uint8_t>(bits >> bit_count & 0xffu));
        }
    }
    return bytes;
}

}  // namespace

SceneFile read_scene_file(const fs::path& path, std::vector<std::string>& warnings) {
    SceneFile scene;
    scene.name = path.filename().string();
    InputFile file(path, path.string());
    scene.folder = fs::canonical(fs::absolute(path).parent_path());
    if (file.size() >= kGlbHeaderBytes && file.read_u32() == kGlbMagic) {
        read_glb(file, scene, warnings);
    } else {
        file.rewind();
        read_json_text(file, file.size(), scene);
    }
    return scene;
}

std::vector<uint8_t> read_uri(const fs::path& folder, const Cursor& uri, uint64_t least, uint64_t most, uint64_t take) {
    const std::string& text = uri.string();
    const auto check_size = [&](uint64_t size) {
        if (size < least) {
            uri.fail(std::to_string(least) + " bytes are declared, the address holds " + std::to_string(size));
        }
        if (take == 0 && size > most)
            uri.fail("the address holds more than " + std::to_string(most >> 20) + " MiB", "split the data");
    };
    if (text.starts_with("data:")) {
        const size_t comma = text.find(',');
        if (comma == std::string::npos) uri.fail("the data address has no data");
        std::vector<uint8_t> bytes;
        if (std::string_view(text).substr(0, comma).ends_with(";base64")) {
            bytes = base64_decoded(std::string_view(text).substr(comma + 1), uri);
        } else {
            const std::string plain = decoded(std::string_view(text).substr(comma + 1), uri);
            bytes.assign(plain.begin(), plain.end());
        }
        check_size(bytes.size());
        if (take != 0) bytes.resize(std::min<uint64_t>(take, bytes.size()));
        return bytes;
    }
    InputFile file(resolve(folder, uri), "named in " + uri.location());
    check_size(file.size());
    std::vector<uint8_t> bytes(take == 0 ? file.size() : std::min(take, file.size()));
    file.read(bytes.data(), bytes.size());
    return bytes;
}

}  // namespace gnomon::gltf
