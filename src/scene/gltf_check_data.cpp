// SPDX-License-Identifier: Apache-2.0
// Checks of buffers, buffer views and accessors.
#include "scene/gltf_check.hpp"
#include "scene/gltf_file.hpp"

namespace gnomon::gltf {

namespace {

constexpr uint64_t kMaxCount = (uint64_t{1} << 31) - 1;  // The parser's integers are 32 bits wide.

struct View {
    uint64_t offset = 0;
    uint64_t bytes = 0;
    uint64_t stride = 0;  // 0: elements follow each other.
};

std::vector<uint64_t> check_buffers(const Cursor& root) {
    std::vector<uint64_t> bytes;
    uint64_t total = 0;
    root.for_each("buffers", [&](const Cursor& buffer, size_t) {
        bytes.push_back(buffer.get("byteLength").integer(1, kMaxCount));
        if (const auto uri = buffer.find("uri")) {
            uri->string();
            total += bytes.back();
            if (total > kMaxBufferBytes) buffer.fail("the buffers have more than 1 GiB together", "split the scene");
        }
    });
    return bytes;
}

std::vector<View> check_views(const Cursor& root, const std::vector<uint64_t>& buffers) {
    std::vector<View> views;
    root.for_each("bufferViews", [&](const Cursor& view, size_t) {
        const uint64_t buffer_bytes = buffers[view.get("buffer").as_index(buffers.size(), "buffers")];
        View v;
        v.offset = view.integer_or("byteOffset", 0, 0, kMaxCount);
        v.bytes = view.get("byteLength").integer(1, kMaxCount);
        if (v.offset + v.bytes > buffer_bytes) {
            view.fail("the view ends at byte " + std::to_string(v.offset + v.bytes) + " of a buffer of " +
                      std::to_string(buffer_bytes) + " bytes");
        }
        v.stride = view.integer_or("byteStride", 0, 4, 252);
        if (v.stride % 4 != 0) view.fail("the stride " + std::to_string(v.stride) + " is not a multiple of 4");
        views.push_back(v);
    });
    return views;
}

// That `count` elements of `bytes` bytes, `stride` apart, from `offset` on lie inside the view and at multiples of `alignment`.
void check_range(const Cursor& where, const View& view, uint64_t offset, uint64_t count, uint64_t bytes, uint64_t stride,
                 uint64_t alignment) {
    if ((view.offset + offset) % alignment != 0) {
        where.fail("the data start at byte " + std::to_string(view.offset + offset) + ", not at a multiple of " +
                   std::to_string(alignment));
    }
    if (stride < bytes) {
        where.fail("elements of " + std::to_string(bytes) + " bytes do not fit a stride of " + std::to_string(stride));
    }
    // All factors are below 2^31, so nothing overflows 64 bits.
    const uint64_t end = offset + (count - 1) * stride + bytes;
    if (end > view.bytes) {
        where.fail("the data end at byte " + std::to_string(end) + " of a view of " + std::to_string(view.bytes) + " bytes");
    }
}

void check_sparse(const Cursor& sparse, const std::vector<View>& views, const AccessorInfo& info) {
    const uint64_t count = sparse.get("count").integer(1, info.count);
    const auto check_part = [&](const Cursor& part, uint64_t bytes, uint64_t stride, uint64_t alignment) {
        const View& view = views[part.get("bufferView").as_index(views.size(), "buffer views")];
        if (view.stride != 0) part.fail("sparse data must not have a stride");
        check_range(part, view, part.integer_or("byteOffset", 0, 0, kMaxCount), count, bytes, stride, alignment);
    };
    const Cursor indices = sparse.get("indices");
    const uint64_t type = indices.get("componentType").integer();
    if (type != kUByte && type != kUShort && type != kUInt) indices.fail("sparse indices must be unsigned integers");
    const uint64_t index_bytes = component_bytes(static_cast<uint32_t>(type));
    check_part(indices, index_bytes, index_bytes, index_bytes);
    check_part(sparse.get("values"), element_bytes(info), packed_stride(info), component_bytes(info.component_type));
}

AccessorInfo check_accessor(const Cursor& accessor, const std::vector<View>& views) {
    AccessorInfo info = shape_of(accessor.get("type").string());
    info.component_type = static_cast<uint32_t>(accessor.get("componentType").integer(0, kMaxCount));
    info.count = accessor.get("count").integer(1, kMaxCount);
    if (const auto normalized = accessor.find("normalized")) info.normalized = normalized->boolean();
    if (component_bytes(info.component_type) == 0) info.columns = 0;
    const std::optional<size_t> view = accessor.index("bufferView", views.size(), "buffer views");
    // Unknown types are for extensions; an error only where something uses them.
    if (info.columns == 0) return info;
    const uint64_t bytes = element_bytes(info);
    const uint64_t offset = accessor.integer_or("byteOffset", 0, 0, kMaxCount);
    if (view) {
        const View& v = views[*view];
        check_range(accessor, v, offset, info.count, bytes, v.stride == 0 ? packed_stride(info) : v.stride,
                    component_bytes(info.component_type));
    }
    if (const auto sparse = accessor.find("sparse")) check_sparse(*sparse, views, info);
    return info;
}

}  // namespace

uint32_t component_bytes(uint32_t component_type) {
    switch (component_type) {
        case kByte:
        case kUByte:
            return 1;
        case kShort:
        case kUShort:
            return 2;
        case kUInt:
        case kFloat:
            return 4;
        default:
            return 0;
    }
}

AccessorInfo shape_of(std::string_view type) {
    AccessorInfo info;
    if (type == "SCALAR") {
        info.columns = info.rows = 1;
    } else if (type.size() == 4 && type[3] >= '2' && type[3] <= '4') {
        const auto size = static_cast<uint32_t>(type[3] - '0');
        if (type.starts_with("VEC")) {
            info.columns = 1;
            info.rows = size;
        } else if (type.starts_with("MAT")) {
            info.columns = info.rows = size;
        }
    }
    return info;
}

uint64_t column_stride(const AccessorInfo& info) {
    const uint64_t bytes = uint64_t{info.rows} * component_bytes(info.component_type);
    return info.columns == 1 ? bytes : (bytes + 3) / 4 * 4;
}

uint64_t element_bytes(const AccessorInfo& info) {
    return (info.columns - 1) * column_stride(info) + uint64_t{info.rows} * component_bytes(info.component_type);
}

uint64_t packed_stride(const AccessorInfo& info) { return info.columns * column_stride(info); }

std::vector<AccessorInfo> check_data(const Cursor& root) {
    const std::vector<View> views = check_views(root, check_buffers(root));
    std::vector<AccessorInfo> accessors;
    root.for_each("accessors", [&](const Cursor& accessor, size_t) { accessors.push_back(check_accessor(accessor, views)); });
    return accessors;
}

}  // namespace gnomon::gltf
