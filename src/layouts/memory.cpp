// SPDX-License-Identifier: Apache-2.0
#include "layouts/memory.hpp"

#include <algorithm>
#include <gnomon/error.hpp>

namespace gnomon {

Totals Totals::operator-(const Totals& before) const {
    Totals result{{}, tiles - before.tiles};
    for (size_t i = 0; i < sizes.size(); ++i) result.sizes[i] = sizes[i] - before.sizes[i];
    return result;
}

uint64_t values_of_size(const LayoutSize& size, const Totals& of) {
    return size.per == LayoutSize::Per::tile ? of.tiles : of.lists();
}

bool knows_each(const LayoutSize& size) { return size.as == LayoutSize::As::values || size.as == LayoutSize::As::offsets; }

uint64_t elements_of(const Layout& layout, const LayoutBuffer& buffer, const Totals& of) {
    switch (buffer.per) {
        case LayoutBuffer::Per::list:
            return of.lists() * buffer.elements;
        case LayoutBuffer::Per::tile:
            return of.tiles * buffer.elements;
        case LayoutBuffer::Per::size:
            return of.sizes[buffer.size] * buffer.elements;
        default:
            break;
    }
    return buffer.length.value([&](const std::string& name) -> uint64_t {
        if (name == "lists") return of.lists();
        if (name == "tiles") return of.tiles;
        for (size_t i = 0; i < layout.sizes.size(); ++i) {
            if (layout.sizes[i].name == name) return of.sizes[i];
        }
        for (const auto& [constant, value] : layout.constants) {
            if (constant == name) return value;
        }
        throw Error(ErrorKind::internal, "a length of what there is not", name, "report this as a bug");
    });
}

uint64_t bytes_of(const Layout& layout, const LayoutBuffer& buffer, const Totals& of) {
    return std::max<uint64_t>(1, elements_of(layout, buffer, of)) * buffer.element_bytes;
}

bool is_whole(const LayoutBuffer& buffer) {
    return buffer.per == LayoutBuffer::Per::band || buffer.per == LayoutBuffer::Per::tile;
}

std::string bytes_formula(const Layout& layout) {
    std::vector<std::pair<std::string, uint64_t>> terms;
    const auto add = [&](const std::string& of, uint64_t bytes) {
        const auto same = std::find_if(terms.begin(), terms.end(), [&](const auto& term) { return term.first == of; });
        if (same == terms.end()) {
            terms.emplace_back(of, bytes);
        } else {
            same->second += bytes;
        }
    };
    for (const LayoutBuffer& buffer : layout.buffers) {
        if (!layout.has(buffer)) continue;
        const uint64_t bytes = uint64_t(buffer.element_bytes) * buffer.elements;
        switch (buffer.per) {
            case LayoutBuffer::Per::list:
                add("lists", bytes);
                break;
            case LayoutBuffer::Per::tile:
                add("tiles", bytes);
                break;
            case LayoutBuffer::Per::size:
                add(layout.sizes[buffer.size].name, bytes);
                break;
            default:
                add("(" + buffer.length.text() + ")", bytes);
                break;
        }
    }
    // Each value, and in the band that is in memory the value or its sum.
    for (const LayoutSize& size : layout.sizes) {
        if (knows_each(size)) add(size.per == LayoutSize::Per::tile ? "tiles" : "lists", 8);
    }
    std::string text;
    for (const auto& [of, bytes] : terms) text += (text.empty() ? "" : " + ") + std::to_string(bytes) + " " + of;
    return text.empty() ? "0" : text;
}

}  // namespace gnomon
