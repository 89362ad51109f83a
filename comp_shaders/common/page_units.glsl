// SPDX-License-Identifier: Apache-2.0
// Units: the entries of the pages that are split, in runs of kPageUnit. Four nodes belong to each page, numbered by its first unit. Needs: params, units (sums), pages,
// common/page.glsl

struct Unit {
    uint number;
    uint first;   // Of its page's units.
    uint count;   // Of them.
    Page page;
};

// The new page, of params.page_count, that a unit belongs to.
uint page_of_unit(uint unit) {
    uint low = 0u, high = params.page_count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        bool after = fetch_units(middle) <= unit;
        low = after ? middle : low;
        high = after ? high : middle;
    }
    return low;
}

Unit fetch_unit(uint number) {
    uint i = page_of_unit(number);
    Unit unit;
    unit.number = number;
    unit.first = fetch_units(i);
    unit.count = fetch_units(i + 1u) - unit.first;
    uint page = params.page_first + i;
    unit.page = unpack_page(params.grid, fetch_pages(2u * page), fetch_pages(2u * page + 1u));
    return unit;
}

// Where the entries of a part are counted that the page's first unit's first invocation, of 8, hands down: those of the others follow, unit by unit.
uint part_place(Unit unit, uint q) { return unit.first * kUnitCounts + q * unit.count * 8u; }

// Entries of a unit, [x, y).
uvec2 unit_entries(Unit unit) {
    uint first = unit.page.begin + (unit.number - unit.first) * kPageUnit;
    return uvec2(first, min(unit.page.end, first + kPageUnit));
}
