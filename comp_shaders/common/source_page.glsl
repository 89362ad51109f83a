// SPDX-License-Identifier: Apache-2.0
// The pages whose lists a raster stage walks. Needs: kAsked, params.grid, params.entry_first, bin_offsets, bin_entries
#include "common/page.glsl"
READ_UVEC4(15, pages)
#include "common/page_entry.glsl"

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
