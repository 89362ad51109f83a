// SPDX-License-Identifier: Apache-2.0
#include "io/openexr.hpp"

#include <new>

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
