// SPDX-License-Identifier: Apache-2.0
// Reading accessors.
#include "scene/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "scene/gltf_check.hpp"

namespace gnomon::gltf {

namespace {

constexpr uint64_t kMaxAccessorBytes = uint64_t{1} << 29;
constexpr uint64_t kMaxDecodedBytes = uint64_t{1} << 31;

AccessorInfo info_of(const tinygltf::Accessor& accessor) {
    static constexpr std::string_view kTypes[] = {"VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    static constexpr int kIds[] = {TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4,
                                   TINYGLTF_TYPE_MAT2, TINYGLTF_TYPE_MAT3, TINYGLTF_TYPE_MAT4};
    AccessorInfo info = shape_of("SCALAR");
    for (size_t i = 0; i < std::size(kIds); ++i) {
        if (accessor.type == kIds[i]) info = shape_of(kTypes[i]);
    }
    info.component_type = static_cast<uint32_t>(accessor.componentType);
    info.normalized = accessor.normalized;
    info.count = accessor.count;
    return info;
}

template <typename Stored, typename Result>
Result converted(const uint8_t* bytes, bool normalized) {
    Stored value;
    std::memcpy(&value, bytes, sizeof value);
    if constexpr (std::is_integral_v<Stored> && std::is_floating_point_v<Result>) {
        if (normalized) {
            return std::max(static_cast<Result>(value) / static_cast<Result>(std::numeric_limits<Stored>::max()), Result{-1});
        }
    }
    return static_cast<Result>(value);
}

template <typename Result>
Result component(const uint8_t* bytes, uint32_t type, bool normalized) {
    switch (type) {
        case kByte:
            return converted<int8_t, Result>(bytes, normalized);
        case kUByte:
            return converted<uint8_t, Result>(bytes, normalized);
        case kShort:
            return converted<int16_t, Result>(bytes, normalized);
        case kUShort:
            return converted<uint16_t, Result>(bytes, normalized);
        case kUInt:
            return converted<uint32_t, Result>(bytes, normalized);
        default:
            break;
    }
    if constexpr (std::is_floating_point_v<Result>) return converted<float, Result>(bytes, normalized);
    return {};  // Integers are never read from floats: the checks see to it.
}

// The bytes of a view from `offset` on. The checks have compared ranges with the declared lengths, which loaded buffers have.
const uint8_t* view_data(const Document& document, int view, size_t offset, int accessor) {
    const tinygltf::BufferView& v = document.model.bufferViews[static_cast<size_t>(view)];
    const std::vector<unsigned char>& data = document.model.buffers[static_cast<size_t>(v.buffer)].data;
    if (data.empty()) {
        throw Error(ErrorKind::input, "buffer " + std::to_string(v.buffer) + " has no data",
                    "in " + document.name + ": /accessors/" + std::to_string(accessor), "export the file with its buffers");
    }
    return data.data() + v.byteOffset + offset;
}

template <typename Result>
void read_elements(const uint8_t* bytes, const AccessorInfo& info, uint64_t stride, uint64_t element, Result* out) {
    const uint32_t size = component_bytes(info.component_type);
    const uint8_t* start = bytes + element * stride;
    for (uint32_t column = 0; column < info.columns; ++column) {
        for (uint32_t row = 0; row < info.rows; ++row) {
            *out++ = component<Result>(start + column * column_stride(info) + row * size, info.component_type, info.normalized);
        }
    }
}

template <typename Result>
void apply_sparse(const Document& document, int number, const AccessorInfo& info, std::vector<Result>& values) {
    const auto& sparse = document.model.accessors[static_cast<size_t>(number)].sparse;
    const uint8_t* indices =
        view_data(document, sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset), number);
    const uint8_t* replacements =
        view_data(document, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset), number);
    AccessorInfo index = shape_of("SCALAR");
    index.component_type = static_cast<uint32_t>(sparse.indices.componentType);
    const size_t width = size_t{info.columns} * info.rows;
    int64_t previous = -1;
    for (uint64_t i = 0; i < static_cast<uint64_t>(sparse.count); ++i) {
        uint32_t at = 0;
        read_elements(indices, index, packed_stride(index), i, &at);
        if (at >= info.count || static_cast<int64_t>(at) <= previous) {
            throw Error(ErrorKind::input, "sparse index " + std::to_string(at) + " is out of range or not ascending",
                        "in " + document.name + ": /accessors/" + std::to_string(number), "repair or export the file again");
        }
        previous = at;
        read_elements(replacements, info, packed_stride(info), i, values.data() + at * width);
    }
}

template <typename Result>
std::vector<Result> read(const Document& document, int number) {
    const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(number)];
    const AccessorInfo info = info_of(accessor);
    const size_t width = size_t{info.columns} * info.rows;
    document.decoded_bytes += float_bytes(accessor);
    if (float_bytes(accessor) > kMaxAccessorBytes || document.decoded_bytes > kMaxDecodedBytes) {
        throw Error(ErrorKind::input, "the scene has too much data",
                    "in " + document.name + ": /accessors/" + std::to_string(number), "render it in parts");
    }
    std::vector<Result> values(info.count * width);
    if (accessor.bufferView >= 0) {
        const size_t view_stride = document.model.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
        const uint64_t stride = view_stride == 0 ? packed_stride(info) : view_stride;
        const uint8_t* bytes = view_data(document, accessor.bufferView, accessor.byteOffset, number);
        for (uint64_t i = 0; i < info.count; ++i) read_elements(bytes, info, stride, i, values.data() + i * width);
    }
    if (accessor.sparse.isSparse) apply_sparse(document, number, info, values);
    return values;
}

}  // namespace

uint32_t width_of(const tinygltf::Accessor& accessor) {
    const AccessorInfo info = info_of(accessor);
    return info.columns * info.rows;
}

uint64_t float_bytes(const tinygltf::Accessor& accessor) { return accessor.count * width_of(accessor) * sizeof(float); }

std::vector<float> read_floats(const Document& document, int accessor) { return read<float>(document, accessor); }

std::vector<uint32_t> read_unsigned(const Document& document, int accessor) { return read<uint32_t>(document, accessor); }

}  // namespace gnomon::gltf
