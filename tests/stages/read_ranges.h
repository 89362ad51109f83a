// SPDX-License-Identifier: Apache-2.0
// Push constants of read_ranges.comp.
#ifndef GNOMON_TEST_READ_RANGES_H
#define GNOMON_TEST_READ_RANGES_H
#include "shared/lang.h"
GN_BEGIN

struct ReadRangesParams {
    uint list_first;
    uint list_count;
    uint range_first;  // The number of the first range in memory.
};

GN_END
#endif
