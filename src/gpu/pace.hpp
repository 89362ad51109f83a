// SPDX-License-Identifier: Apache-2.0
// Inside src/gpu only: how long the workgroups of a stage take, and how many may therefore run as one dispatch.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace gnomon::gpu {

/// Workgroups in rows of equal length, x by y.
struct Grid {
    uint64_t x = 0;
    uint64_t y = 0;
};

/// At least `groups` workgroups, fewer than y more. Rows have at most `longest_row` where max_groups rows are enough for that;
/// x is more than max_groups where that is too few.
Grid spread_groups(uint64_t groups, uint64_t max_groups, uint64_t longest_row);

/// Systems stop a device that works too long at one thing. A dispatch is cut into pieces that are expected to take
/// `piece_seconds`, by what its stage took before; what is not known is found out by small pieces first. Keys are of a stage
/// and its program.
class Pace {
public:
    explicit Pace(double piece_seconds) : piece_seconds_(piece_seconds) {}

    struct Piece {
        uint64_t groups = 0;   ///< At least 1, at most those that are left.
        double seconds = 0.0;  ///< Expected.
        bool probe = false;    ///< To be measured before more is run: more workgroups than this are not known to be safe.
    };
    /// The next piece of a dispatch of which `left` workgroups are left.
    Piece next(const std::string& key, uint64_t left) const;
    /// Most workgroups of a row, so that a piece can be cut well from whole rows.
    uint64_t longest_row(const std::string& key) const;
    /// Whether this many are expected to take no longer than a piece, as far as anything is known of them. The dispatch is not
    /// cut.
    bool fits(const std::string& key, uint64_t groups) const;
    void measured(const std::string& key, uint64_t groups, double seconds);

    /// The device may be given this much before it is waited for.
    double submission_seconds() const { return kPiecesPerSubmission * piece_seconds_; }
    /// Commands of one stage may be measured together for this long.
    double merged_seconds() const { return piece_seconds_ / 8; }

private:
    static constexpr double kPiecesPerSubmission = 5.0;

    struct Known {
        double seconds_per_group = 0.0;
        uint64_t groups = 0;       // of the measurement that it is of
        uint64_t most_groups = 0;  // measured in one piece
    };
    const Known* find(const std::string& key) const;

    double piece_seconds_;
    std::map<std::string, Known> known_;
};

}  // namespace gnomon::gpu
