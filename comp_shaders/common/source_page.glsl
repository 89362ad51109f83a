// SPDX-License-Identifier: Apache-2.0
// The pages whose lists a raster stage walks. Needs: kAsked, params.grid, params.entry_first, bin_offsets, bin_entries
#include "common/page.glsl"
READ_UVEC4(15, pages)
READ_UINT(41, page_entries)  // Layouts have bindings 16 to 39.

Page fetch_page(uint number) {
    Page page;
    if (kAsked) {
        page = unpack_page(params.grid, fetch_pages(2u * number), fetch_pages(2u * number + 1u));
        if (page.split != 0u) page.end = page.begin;
    } else {
        page = item_page(params.grid, number, fetch_bin_offsets(number), fetch_bin_offsets(number + 1u));
    }
    return page;
}

// Entry `k` of a page's list.
uint fetch_page_entry(uint k) {
    bool handed_down = kAsked && k >= params.entry_first;
    uint own = fetch_bin_entries(handed_down ? 0u : k);
    return handed_down ? fetch_page_entries(k - params.entry_first) : own;
}
