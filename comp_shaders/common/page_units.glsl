// SPDX-License-Identifier: Apache-2.0
// Units: the entries of the pages that are split, in runs of kPageUnit. Four nodes belong to each page, numbered by its first unit. Needs: params, units (sums)

// The new page, of params.page_count, that the unit belongs to.
uint page_of_unit(uint unit) {
    uint low = 0u, high = params.page_count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (fetch_units(middle) <= unit) low = middle;
        else high = middle;
    }
    return low;
}
