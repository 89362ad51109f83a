// SPDX-License-Identifier: Apache-2.0
#include "io/sbuffer_file.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "io/openexr.hpp"

namespace gnomon::io {

namespace {

constexpr int kMostWidth = 16384;
constexpr int kMostHeight = 6 * kMostWidth;  // The faces of a point light.
constexpr const char* kHint = "make it with gnomon render --dump-sbuffer";

struct FileChannel {
    const char* name;
    float FileRange::*value;
    bool only_with_exits = false;
};

constexpr std::array<FileChannel, 8> kChannels = {{{"Z", &FileRange::z},
                                                   {"ZBack", &FileRange::z_back},
                                                   {"time.enter", &FileRange::enter},
                                                   {"time.exit", &FileRange::exit},
                                                   {"triangle", &FileRange::triangle},
                                                   {"A", &FileRange::alpha},
                                                   {"depth.enter", &FileRange::enter_depth, true},
                                                   {"depth.exit", &FileRange::exit_depth, true}}};

/// Where OpenEXR finds or puts a row of pixels, whichever row it is.
class RowBuffer {
public:
    /// first_column: of the data window.
    RowBuffer(SBufferFile::Row& row, uint32_t width, int first_column, bool exit_depths)
        : row_(row), first_column_(first_column) {
        row_.counts.resize(width);
        buffer_.insertSampleCountSlice(slice<Imf::Slice>(row_.counts, Imf::UINT));
        for (size_t c = 0; c < kChannels.size(); ++c) {
            places_[c].resize(width);
            if (kChannels[c].only_with_exits && !exit_depths) continue;
            buffer_.insert(kChannels[c].name, slice<Imf::DeepSlice>(places_[c], Imf::FLOAT, sizeof(FileRange)));
        }
    }

    const Imf::DeepFrameBuffer& buffer() const { return buffer_; }

    /// After the row's counts were changed: its ranges become as many.
    void make_room() {
        row_.ranges.resize(std::accumulate(row_.counts.begin(), row_.counts.end(), uint64_t{0}));
        FileRange* range = row_.ranges.data();
        for (size_t x = 0; x < row_.counts.size(); range += row_.counts[x++]) {
            for (size_t c = 0; c < kChannels.size(); ++c)
                places_[c][x] = row_.counts[x] > 0 ? &(range->*kChannels[c].value) : nullptr;
        }
    }

private:
    /// Of elements that are one for each column; all rows have the same.
    template <class Slice, class Element, class... More>
    Slice slice(std::vector<Element>& elements, Imf::PixelType type, More... more) const {
        char* const first = reinterpret_cast<char*>(elements.data());
        return Slice(type, first - int64_t(first_column_) * int64_t(sizeof(Element)), sizeof(Element), 0, more...);
    }

    SBufferFile::Row& row_;
    int first_column_;
    std::array<std::vector<float*>, kChannels.size()> places_;
    Imf::DeepFrameBuffer buffer_;
};

FileRange file_range(const TexelRange& r) {
    return {.z = std::min(r.depth, r.exit_depth),
            .z_back = std::max(r.depth, r.exit_depth),
            .enter = r.enter,
            .exit = r.leave,
            .triangle = static_cast<float>(r.triangle),
            .alpha = 1.0f,
            .enter_depth = r.depth,
            .exit_depth = r.exit_depth};
}

}  // namespace

void write_sbuffer(const std::filesystem::path& path, const LightRanges& light,
                   const std::map<std::string, std::string>& attributes) {
    const auto inexact = [](const TexelRange& r) { return r.triangle > kMostDumpedTriangles; };
    if (std::any_of(light.ranges.begin(), light.ranges.end(), inexact))
        throw Error(ErrorKind::input, "numbers of triangles above 16777216 are not exact in 32-bit floats", path.string(),
                    "dump the S-buffer of a smaller scene");
    Imf::Header header(static_cast<int>(light.width), static_cast<int>(light.height));
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    set_text_attributes(header, attributes);
    for (const FileChannel& channel : kChannels) {
        if (light.exit_depths || !channel.only_with_exits) header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    }
    SBufferFile::Row row;
    RowBuffer buffer(row, light.width, 0, light.exit_depths);
    write_openexr(path, [&](Imf::OStream& stream) {
        Imf::DeepScanLineOutputFile output(stream, header);
        output.setFrameBuffer(buffer.buffer());
        auto range = light.ranges.begin();
        for (uint64_t y = 0; y < light.height; ++y) {
            const auto first = range;
            std::fill(row.counts.begin(), row.counts.end(), 0u);
            for (; range != light.ranges.end() && range->texel < (y + 1) * light.width; ++range)
                ++row.counts[range->texel - y * light.width];
            buffer.make_room();
            std::transform(first, range, row.ranges.begin(), file_range);
            output.writePixels(1);
        }
    });
}

struct SBufferFile::Impl {
    explicit Impl(const std::filesystem::path& file_path) : path(file_path), file(file_path.c_str()) {
        if (file.parts() != 1) throw_cannot_read(path, "it has " + std::to_string(file.parts()) + " parts", kHint);
        const Imf::Header& header = file.header(0);
        if (!header.hasType() || header.type() != Imf::DEEPSCANLINE)
            throw_cannot_read(path, "it has no deep scanlines, so it is no S-buffer", kHint);
        const Imf::ChannelList& channels = header.channels();
        const auto has = [&](const char* name) {
            const Imf::Channel* channel = channels.findChannel(name);
            return channel != nullptr && channel->type == Imf::FLOAT;
        };
        exit_depths = has("depth.enter") && has("depth.exit");
        for (const FileChannel& channel : kChannels) {
            if (!channel.only_with_exits && !has(channel.name))
                throw_cannot_read(path, std::string("it has no channel ") + channel.name + " of floats, so it is no S-buffer",
                                  kHint);
        }
        const Imath::Box2i window = header.dataWindow();
        width = static_cast<uint32_t>(int64_t{window.max.x} - window.min.x + 1);
        height = static_cast<uint32_t>(int64_t{window.max.y} - window.min.y + 1);
        first_column = window.min.x;
        first_row = window.min.y;
        most_ranges =
            std::filesystem::file_size(path) * most_compression(header.compression()) / (sizeof(float) * kChannels.size());
        attributes = text_attributes(header);
        part = std::make_unique<Imf::DeepScanLineInputPart>(file, 0);
    }

    std::filesystem::path path;
    Imf::MultiPartInputFile file;
    std::unique_ptr<Imf::DeepScanLineInputPart> part;
    uint32_t width = 0, height = 0;
    int first_column = 0, first_row = 0;
    uint64_t most_ranges = 0;  ///< That the file can hold.
    bool exit_depths = false;
    std::map<std::string, std::string> attributes;
};

SBufferFile::SBufferFile(const std::filesystem::path& path) {
    read_openexr(path, kMostWidth, kMostHeight, [&] { impl_ = std::make_unique<Impl>(path); });
}

SBufferFile::~SBufferFile() = default;
SBufferFile::SBufferFile(SBufferFile&&) noexcept = default;

const std::filesystem::path& SBufferFile::path() const { return impl_->path; }
uint32_t SBufferFile::width() const { return impl_->width; }
uint32_t SBufferFile::height() const { return impl_->height; }
bool SBufferFile::exit_depths() const { return impl_->exit_depths; }
const std::map<std::string, std::string>& SBufferFile::attributes() const { return impl_->attributes; }

SBufferFile::Row SBufferFile::row(uint32_t y) const {
    Row row;
    read_openexr(impl_->path, kMostWidth, kMostHeight, [&] {
        RowBuffer buffer(row, impl_->width, impl_->first_column, impl_->exit_depths);
        const int line = impl_->first_row + static_cast<int>(y);
        impl_->part->setFrameBuffer(buffer.buffer());
        impl_->part->readPixelSampleCounts(line, line);
        if (std::accumulate(row.counts.begin(), row.counts.end(), uint64_t{0}) > impl_->most_ranges)
            throw_cannot_read(impl_->path, "row " + std::to_string(y) + " promises more ranges than the file holds",
                              "make it again: it is damaged");
        buffer.make_room();
        impl_->part->readPixels(line, line);
    });
    if (!impl_->exit_depths) {
        for (FileRange& range : row.ranges) {
            range.enter_depth = range.z;
            range.exit_depth = range.z_back;
        }
    }
    return row;
}

}  // namespace gnomon::io
