// SPDX-License-Identifier: Apache-2.0
// What shadow tests read of a layout, counted from records of it.
#pragma once

#include <gnomon/render.hpp>
#include <span>

#include "layouts/dependences.hpp"
#include "layouts/manifest.hpp"
#include "shared/params.h"

namespace gnomon {

/// Bytes of an element of what shared::LayoutRead::what numbers: the buffers, then the sizes.
std::vector<uint32_t> element_bytes(const Layout& layout);

/// By what names a stage reads them.
std::vector<std::string> names_of_reads(const Layout& layout);

/// Add the reads of one dispatch, whose records of each hit come in the order in which it read. Buffers are taken to begin at a
/// line.
void add_reads(std::span<const shared::LayoutRead> reads, const std::vector<uint32_t>& element_bytes,
               const Dependences& dependences, LayoutAccesses& sum);

}  // namespace gnomon
