// SPDX-License-Identifier: Apache-2.0
// The lists of pages. Needs: params.entry_first, bin_entries
READ_UINT(41, page_entries)  // Layouts have bindings 16 to 39.

// Entry `k` of all lists: the bins', then those that were handed down to pages.
uint fetch_page_entry(uint k) {
    bool handed_down = k >= params.entry_first;
    uint from_bins = fetch_bin_entries(handed_down ? 0u : k);
    return handed_down ? fetch_page_entries(k - params.entry_first) : from_bins;
}
