// SPDX-License-Identifier: Apache-2.0
// What the shadow tests of one light read, by whatever method.
#pragma once

#include <gnomon/error.hpp>
#include <map>
#include <string>
#include <vector>

#include "gpu/gpu.hpp"

namespace gnomon {

class SBuffer;

/// A run of items (a tile of a window in a cell of time) and the elements of their texels.
struct Band {
    uint32_t item_first = 0;
    uint32_t item_count = 0;
    uint64_t range_first = 0;
    uint64_t range_count = 0;
    double t_open = 0.0;  ///< The part of the shutter that it serves.
    double t_close = 1.0;
};

/// How items are numbered: tile * cell_count + cell, or cell * tile_count + tile; tiles from the window's first.
struct ItemOrder {
    uint32_t cell_count = 1;  ///< Equal parts of the shutter.
    bool cell_major = false;
};

/// Not even the least band fits into what there is of memory.
class BandTooLarge : public Error {
public:
    /// what: takes `needed` bytes of the `available`. other_way: what else helps.
    BandTooLarge(const std::string& what, const std::string& where, uint64_t needed_bytes, uint64_t available_bytes,
                 std::string other_way)
        : Error(ErrorKind::out_of_memory, what + " take " + std::to_string(needed_bytes) + " bytes", where, ""),
          needed(needed_bytes),
          available(available_bytes),
          other(std::move(other_way)) {}

    /// Of one that had a share of what is available.
    BandTooLarge(const BandTooLarge& part, uint64_t share)
        : Error(part), needed(part.needed * share), available(part.available * share), other(part.other) {}

    uint64_t needed, available;
    std::string other;
};

/// Of one window of a light's view.
class ShadowMap {
public:
    ShadowMap() = default;
    ShadowMap(const ShadowMap&) = delete;
    ShadowMap& operator=(const ShadowMap&) = delete;
    virtual ~ShadowMap() = default;

    virtual ItemOrder order() const = 0;
    virtual uint32_t item_count() const = 0;
    /// Most elements that one test walks.
    virtual uint64_t longest() const { return 1; }

    /// Bands that take at most `bytes` each; one, if all of it does. Errors: BandTooLarge.
    virtual std::vector<Band> bands(uint64_t bytes) const = 0;
    /// For the report: what there is of it, and how it was made.
    virtual std::map<std::string, uint64_t> counts() const { return {}; }
    virtual std::map<std::string, std::string> effective() const { return {}; }

    /// Fill a band; the one before is forgotten.
    virtual void fill(const Band& band) = 0;

    /// What holds its ranges; none for maps without.
    virtual const SBuffer* s_buffer() const { return nullptr; }

    /// What the test reads, the number of the first element in memory, and specialization constants of its own: constant_id 8,
    /// 9, ... (common/shadow_test.glsl).
    virtual std::vector<gpu::Binding> read_bindings() const = 0;
    virtual uint32_t range_base() const { return 0; }
    virtual std::vector<uint32_t> test_constants() const { return {}; }
};

}  // namespace gnomon
