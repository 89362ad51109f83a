// SPDX-License-Identifier: Apache-2.0
// The ranges of a light's faces, window by window and band by band, as one S-buffer in texels and in one order.
#pragma once

#include <gnomon/render.hpp>

#include "stages/programs.hpp"
#include "stages/s_buffer.hpp"
#include "views/view.hpp"

namespace gnomon {

/// Anything of the whole scene's S-buffers is asked for.
inline bool keeps_ranges(const RenderSettings& settings) { return settings.keep_texel_ranges || settings.keep_ranges; }
/// That, or something of the S-buffers that make the picture.
inline bool reads_lists(const RenderSettings& settings) { return keeps_ranges(settings) || settings.keep_list_lengths; }

class RangeCollector {
public:
    RangeCollector(const RenderSettings& settings, bool exit_depths);

    /// The view of the next face of the light, below those before; all are as wide.
    void begin_face(const View& view);
    /// The lists of a band of it that is filled.
    void read(gpu::Device& device, Programs& programs, const SBuffer& s_buffer, const Band& band);
    /// Into Frame::list_lengths, Frame::texel_ranges and Frame::light_ranges, behind the lights before. Afterwards this is
    /// empty.
    void finish(Frame& frame);

private:
    bool keep_counts_, keep_ranges_, keep_lengths_, any_ = false;
    uint32_t row_first_ = 0;          ///< Of the face.
    bool reciprocal_depths_ = false;  ///< The face's ranges hold -1 / metres.
    LightRanges light_;
    std::vector<uint32_t> counts_;
    std::vector<uint64_t> lengths_;
};

}  // namespace gnomon
