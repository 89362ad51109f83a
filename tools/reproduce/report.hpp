// SPDX-License-Identifier: Apache-2.0
// What was measured of a figure, as a page to read and as JSON.
#pragma once

#include "io/report.hpp"
#include "reproduce/claim.hpp"
#include "reproduce/measure.hpp"

namespace gnomon::reproduce {

struct FigureReport {
    const Figure& figure;
    const ExperimentResult& result;
    std::vector<ClaimResult> claims;
    MeasureOptions options;
    std::string device;
};

/// The whole page: it needs no other file and no network.
std::string to_html(const FigureReport& report);

/// The document "gnomon.reproduce":
///   figure, title, paper, shows                 strings
///   device, scale, repeat, reference_spp
///   claims     [{quote, source, run, verdict, checks: [{scene, statement, measured, verdict}]}]; verdict: "holds",
///              "does not hold", "undecided"
///   settings   [{scene, x, width, height, spp, shadow_res, segments, triangles, runs}]
///   runs       [{label, method, parameters, effective, metrics, stages, buffers, counts}]
///   metrics    {name: {value, standard_error}}: shares of 1, seconds, bytes
///   stages     [{name, seconds: {value, standard_error}, map_seconds: {...}}]
io::Json to_json(const FigureReport& report);

/// A line of the page over all figures.
struct IndexEntry {
    std::string figure;
    std::string title;
    std::string shows;
    std::string paper;
    std::vector<ClaimResult> claims;
};

/// The page that leads to NAME.html for each figure, with all claims.
std::string index_html(const std::vector<IndexEntry>& entries, const MeasureOptions& options, const std::string& device);

}  // namespace gnomon::reproduce
