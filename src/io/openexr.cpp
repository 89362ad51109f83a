// SPDX-License-Identifier: Apache-2.0
#include "io/openexr.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <new>
#include <string_view>
#include <utility>

namespace gnomon::io {

namespace {

class OutputStream : public Imf::OStream {
public:
    OutputStream(AtomicFile& file, const std::string& name) : Imf::OStream(name.c_str()), file_(file) {}

    void write(const char data[], int count) override {
        file_.write(std::as_bytes(std::span(data, static_cast<size_t>(count))));
    }
    uint64_t tellp() override { return file_.position(); }
    void seekp(uint64_t position) override { file_.seek(position); }

private:
    AtomicFile& file_;
};

// A header as OpenEXR 3.1 reads it. Of these types it takes so many bytes, whatever the attribute says that its size is; of all
// others as much memory as that, before it reads.
class HeaderCheck {
public:
    explicit HeaderCheck(const std::filesystem::path& path)
        : path_(path), file_(path, std::ios::binary), bytes_(std::filesystem::file_size(path)) {}

    /// Throws where an attribute is longer than the file, or not as long as it says. What else is wrong is OpenEXR's to say.
    void run() {
        constexpr uint32_t kSeveralParts = 0x1000;  // Headers until an empty one, instead of one.
        read<uint32_t>();                           // That it is OpenEXR.
        const auto version = read<uint32_t>();
        do {
            while (read_name()) check_attribute();
        } while ((version & kSeveralParts) != 0 && file_ && file_.peek() != '\0');
    }

private:
    static uint64_t fixed_size(std::string_view type) {
        static constexpr std::pair<std::string_view, uint64_t> kSizes[] = {{"box2f", 16},
                                                                           {"box2i", 16},
                                                                           {"chromaticities", 32},
                                                                           {"compression", 1},
                                                                           {"deepImageState", 1},
                                                                           {"double", 8},
                                                                           {"envmap", 1},
                                                                           {"float", 4},
                                                                           {"int", 4},
                                                                           {"keycode", 28},
                                                                           {"lineOrder", 1},
                                                                           {"m33d", 72},
                                                                           {"m33f", 36},
                                                                           {"m44d", 128},
                                                                           {"m44f", 64},
                                                                           {"rational", 8},
                                                                           {"tiledesc", 9},
                                                                           {"timecode", 8},
                                                                           {"v2d", 16},
                                                                           {"v2f", 8},
                                                                           {"v2i", 8},
                                                                           {"v3d", 24},
                                                                           {"v3f", 12},
                                                                           {"v3i", 12}};
        const auto* found = std::find_if(std::begin(kSizes), std::end(kSizes), [&](const auto& s) { return s.first == type; });
        return found == std::end(kSizes) ? 0 : found->second;
    }

    void check_attribute() {
        read_name();
        const std::string type = name_;
        const uint64_t size = read<uint32_t>();
        if (!file_) return;
        const auto begin = static_cast<uint64_t>(file_.tellg());
        if (size > bytes_ - begin) fail("its header promises more than the file holds");
        uint64_t taken = fixed_size(type);
        if (type == "chlist") {
            while (read_name()) file_.seekg(16, std::ios::cur);
            taken = file_ ? static_cast<uint64_t>(file_.tellg()) - begin : 0;
        } else if (type == "preview") {
            const uint64_t width = read<uint32_t>(), height = read<uint32_t>();
            taken = 8 + 4 * width * height;
        }
        if (taken != 0 && taken != size) fail("an attribute of its header is not as long as it says");
        file_.seekg(static_cast<std::streamoff>(begin + size));
    }

    template <class T>
    T read() {
        T value{};
        file_.read(reinterpret_cast<char*>(&value), sizeof value);
        return value;
    }
    /// False at the end of a list: its name is empty.
    bool read_name() {
        std::array<char, 256> name{};
        file_.getline(name.data(), name.size(), '\0');
        name_ = name.data();
        return file_ && !name_.empty();
    }
    [[noreturn]] void fail(const char* reason) const { throw_cannot_read(path_, reason, "make it again: it is damaged"); }

    const std::filesystem::path& path_;
    std::ifstream file_;
    uint64_t bytes_;
    std::string name_;
};

}  // namespace

// Deflate makes at most 1032 bytes of one; before it DWA makes one 16-bit value of 8x8 pixels. PIZ has runs of up to 256 values
// in a code.
uint64_t most_compression(Imf::Compression compression) {
    constexpr uint64_t kDeflate = 1032;
    switch (compression) {
        case Imf::NO_COMPRESSION:
            return 1;
        case Imf::RLE_COMPRESSION:
            return 128;
        case Imf::ZIPS_COMPRESSION:
        case Imf::ZIP_COMPRESSION:
            return kDeflate;
        case Imf::PXR24_COMPRESSION:  // Of floats 24 bits are kept.
            return kDeflate * 4 / 3;
        default:
            return kDeflate * 64;
    }
}

void throw_cannot_read(const std::filesystem::path& path, const std::string& reason, const std::string& hint) {
    throw Error(ErrorKind::input, "cannot read the image: " + reason, path.string(), hint);
}

void set_text_attributes(Imf::Header& header, const std::map<std::string, std::string>& attributes) {
    for (const auto& [name, text] : attributes) header.insert(name, Imf::StringAttribute(text));
}

std::map<std::string, std::string> text_attributes(const Imf::Header& header) {
    std::map<std::string, std::string> attributes;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
            attributes[attribute.name()] = text->value();
    attributes.erase("type");
    return attributes;
}

void write_openexr(const std::filesystem::path& path, const std::function<void(Imf::OStream&)>& write) {
    AtomicFile file(path);
    try {
        OutputStream stream(file, path.string());
        write(stream);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw Error(ErrorKind::internal, std::string("OpenEXR refused the image: ") + error.what(), path.string(),
                    "please report it");
    }
    file.commit();
}

void read_openexr(const std::filesystem::path& path, int most_width, int most_height, const std::function<void()>& read) {
    std::error_code status_error;
    if (!std::filesystem::exists(path, status_error)) throw_cannot_read(path, "there is no such file", "check its name");
    if (!std::filesystem::is_regular_file(path, status_error))
        throw_cannot_read(path, "it is not a regular file", "name an OpenEXR file");
    HeaderCheck(path).run();
    Imf::Header::setMaxImageSize(most_width, most_height);
    Imf::Header::setMaxTileSize(most_width, most_height);
    try {
        read();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        std::string reason = error.what();
        if (reason.ends_with('.')) reason.pop_back();
        throw_cannot_read(path, reason, "check that it is a whole OpenEXR file");
    }
}

}  // namespace gnomon::io
