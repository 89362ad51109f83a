// SPDX-License-Identifier: Apache-2.0
// OpenEXR images: any number of float channels and text in the header.
#include "io/exr.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>

#include <algorithm>
#include <cassert>

#include "io/openexr.hpp"

namespace gnomon::io {

namespace {

// The largest pictures that gnomon makes, along a side; and most bytes of one that is read.
constexpr int kMostSide_px = 16384;
constexpr uint64_t kMostBytes = uint64_t{4} << 30;

/// `values` hold a row-major image whose first pixel is (x, y) in the file's coordinates.
Imf::Slice slice_of(float* values, const Imath::V2i& origin, uint32_t width, uint32_t height) {
    return Imf::Slice::Make(Imf::FLOAT, values, origin, width, height, sizeof(float), sizeof(float) * width);
}

uint64_t bytes_of_pixel(const Imf::ChannelList& channels) {
    uint64_t bytes = 0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        bytes += channel.channel().type == Imf::HALF ? 2 : 4;
    return bytes;
}

ExrImage read_part(Imf::MultiPartInputFile& file, const std::filesystem::path& path) {
    const std::string hint = "convert it to a flat OpenEXR image of one part";
    if (file.parts() != 1) throw_cannot_read(path, "it has " + std::to_string(file.parts()) + " parts", hint);
    const Imf::Header& header = file.header(0);
    if (header.hasType() && Imf::isDeepData(header.type())) throw_cannot_read(path, "its pixels are deep", hint);

    const Imath::Box2i window = header.dataWindow();
    ExrImage image;
    image.width = static_cast<uint32_t>(int64_t{window.max.x} - window.min.x + 1);
    image.height = static_cast<uint32_t>(int64_t{window.max.y} - window.min.y + 1);
    const uint64_t pixels = uint64_t{image.width} * image.height;

    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw_cannot_read(path, std::string("its channel ") + channel.name() + " is subsampled", hint);
        image.channels.push_back({channel.name(), {}});
    }
    Imf::InputPart part(file, 0);
    const uint64_t file_bytes = std::filesystem::file_size(path), pixel_bytes = bytes_of_pixel(header.channels());
    const bool too_small = pixels * pixel_bytes > file_bytes * most_compression(header.compression());
    if (too_small || !part.isComplete())
        throw_cannot_read(path, "its header promises more pixels than the file holds", "make it again: it is damaged");
    const uint64_t bytes = pixels * image.channels.size() * sizeof(float);
    if (bytes > kMostBytes)
        throw_cannot_read(path,
                          "it takes " + std::to_string(bytes >> 20) + " MiB, more than " + std::to_string(kMostBytes >> 20),
                          "leave out channels, or cut it into parts");

    Imf::FrameBuffer frame_buffer;
    for (Channel& channel : image.channels) {
        channel.values.reserve(pixels);
        frame_buffer.insert(channel.name, slice_of(channel.values.data(), window.min, image.width, image.height));
    }
    part.setFrameBuffer(frame_buffer);
    // Memory is taken as the file turns out to hold what its header promises.
    constexpr int kRows = 256;
    for (int first = window.min.y; first <= window.max.y; first += kRows) {
        const int last = std::min(first + kRows - 1, window.max.y);
        for (Channel& channel : image.channels)
            channel.values.resize(uint64_t{image.width} * static_cast<uint64_t>(last - window.min.y + 1));
        part.readPixels(first, last);
    }

    image.attributes = text_attributes(header);
    return image;
}

}  // namespace

const Channel* ExrImage::find(const std::string& name) const {
    const auto found = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
    return found == channels.end() ? nullptr : &*found;
}

void write_exr(const std::filesystem::path& path, uint32_t width, uint32_t height, std::span<const Channel> channels,
               const std::map<std::string, std::string>& attributes) {
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = Imf::ZIP_COMPRESSION;
    set_text_attributes(header, attributes);

    Imf::FrameBuffer frame_buffer;
    for (const Channel& channel : channels) {
        assert(channel.values.size() == uint64_t{width} * height);
        assert(header.channels().findChannel(channel.name) == nullptr);
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
        // The frame buffer of an output file is only read from; its type has no const.
        frame_buffer.insert(channel.name, slice_of(const_cast<float*>(channel.values.data()), {0, 0}, width, height));
    }

    write_openexr(path, [&](Imf::OStream& stream) {
        Imf::OutputFile output(stream, header);
        output.setFrameBuffer(frame_buffer);
        output.writePixels(static_cast<int>(height));
    });
}

ExrImage read_exr(const std::filesystem::path& path) {
    ExrImage image;
    read_openexr(path, kMostSide_px, kMostSide_px, [&] {
        Imf::MultiPartInputFile file(path.c_str());
        image = read_part(file, path);
    });
    return image;
}

}  // namespace gnomon::io
