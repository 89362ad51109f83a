// SPDX-License-Identifier: Apache-2.0
// The rows of a benchmark as JSON and CSV.
#include "bench/report.hpp"

#include <gnomon/version.hpp>
#include <sstream>
#include <thread>

#include "timing/machine.hpp"

namespace gnomon::bench {
namespace {

Json context_json(const Context& context, const std::vector<Row>& rows) {
    const Settings& s = context.settings;
    Json versions = {{"gnomon", GNOMON_VERSION}, {"embree", nullptr}, {"compiler", __VERSION__}};
    if (!rows.empty()) {
        const std::string& embree = rows.front().embree_stats.device;  // "Embree 3.13.5, 2 threads"
        versions["embree"] = embree.substr(0, embree.find(','));
    }
    const std::string cpu = timing::cpu_name();
    return {{"date", timing::utc_now()},
            {"num_cpus", std::thread::hardware_concurrency()},
            {"cpu", cpu.empty() ? Json(nullptr) : Json(cpu)},
            {"load_avg", timing::load_average()},
            {"library_build_type", timing::build_type()},
            {"device", context.device.name},
            {"device_type", context.device.type},
            {"driver", context.device.driver},
            {"versions", versions},
            {"width", s.width},
            {"height", s.height},
            {"shadow_res", s.shadow_res},
            {"threads", s.threads},
            {"repetitions", s.repeat},
            {"pages", s.pages},
            {"scale", context.scale}};
}

Json summary_json(const timing::Summary& summary) {
    return {{"median", summary.median}, {"min", summary.least}, {"max", summary.most}, {"runs", summary.samples}};
}

Json optional_json(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json names_json(const Row& row, const std::string& program) {
    const Settings& s = row.settings;
    const std::string name = "frame/" + row.scene + "/spp:" + std::to_string(s.spp) + "/" + program;
    return {{"name", name},
            {"run_name", name},
            {"run_type", "iteration"},
            {"scene", row.scene},
            {"group", row.group},
            {"value", row.value > 0.0 ? Json(growth_value(row)) : Json(nullptr)},
            {"spp", s.spp},
            {"width", s.width},
            {"height", s.height},
            {"shadow_res", s.shadow_res},
            {"program", program},
            {"threads", s.threads},
            {"repetitions", s.repeat},
            {"iterations", 1}};
}

// What the entries of both programs have.
Json entry_json(const Row& row, const std::string& program, const Timing& timing, const FrameStats& stats) {
    Json stages = Json::array();
    for (const FrameStats::Stage& stage : timing.stages) {
        stages.push_back({{"name", stage.name}, {"seconds", stage.seconds}, {"dispatches", stage.dispatches}});
    }
    Json entry = names_json(row, program);
    entry.update({{"real_time", timing.wall.median},
                  {"cpu_time", timing.cpu.median},
                  {"time_unit", "s"},
                  {"wall_seconds", summary_json(timing.wall)},
                  {"cpu_seconds", summary_json(timing.cpu)},
                  {"busy_share", timing.cpu.median / (timing.wall.median * row.settings.threads)},
                  {"stages", stages},
                  {"rest_seconds", summary_json(timing.rest)},
                  {"counts", stats.counts}});
    return entry;
}

Json work_json(const Work& work) {
    return {{"light_entries", work.light_entries},
            {"ranges", work.ranges},
            {"tests_per_sample", work.tests_per_sample},
            {"traced_tests", work.traced_tests},
            {"core_ns_per_8_tests", optional_json(work.core_ns_per_8_tests)},
            {"ranges_per_second", optional_json(work.ranges_per_second)},
            {"visited_per_shadow_test", optional_json(work.visited_per_shadow_test)},
            {"tested_per_shadow_test", optional_json(work.tested_per_shadow_test)},
            {"trace_yardstick_seconds", optional_json(work.trace_yardstick_seconds)},
            {"raster_yardstick_seconds", optional_json(work.raster_yardstick_seconds)}};
}

Json gnomon_json(const Row& row) {
    if (!row.refusal.empty()) {
        Json entry = names_json(row, "gnomon");
        entry.update({{"error_occurred", true}, {"error_message", row.refusal}});
        return entry;
    }
    Json entry = entry_json(row, "gnomon", row.gnomon, row.gnomon_stats);
    entry["load_seconds"] = row.load_seconds;
    entry["first_frame_seconds"] = row.first_seconds;
    entry["effective"] = row.effective;
    entry["buffers"] = row.gnomon_stats.buffer_bytes;
    entry["peak_bytes"] = row.gnomon_stats.peak_bytes;
    entry["embree_over_gnomon"] = summary_json(row.ratio);
    entry["embree_over_gnomon_cpu"] = summary_json(row.cpu_ratio);
    entry["work"] = work_json(row.work);
    entry["agreement"] = {{"samples", row.agreement.samples},
                          {"hits", row.agreement.hit_share()},
                          {"shadow_tests", row.agreement.shadow_tests},
                          {"shadows", row.agreement.shadow_share()}};
    return entry;
}

Json variant_json(const PeerBuild& build, const PeerRays& rays) {
    return {{"segments", build.segments},
            {"quality", name_of(build.quality)},
            {"calls", name_of(rays.calls)},
            {"order", name_of(rays.order)}};
}

Json embree_json(const Row& row) {
    Json entry = entry_json(row, "embree", row.embree, row.embree_stats);
    entry["peer"] = variant_json(row.build, row.rays);
    entry["trials"] = Json::array();
    for (const Trial& trial : row.trials) {
        Json json = variant_json(trial.build, trial.rays);
        json.update({{"whole", trial.whole}, {"wall_seconds", trial.seconds.wall}, {"cpu_seconds", trial.seconds.cpu}});
        entry["trials"].push_back(std::move(json));
    }
    entry["picture_errors"] = {{"colour", row.peer_errors.colour}, {"visibility", row.peer_errors.visibility}};
    return entry;
}

std::string csv_line(const Row& row) {
    std::ostringstream line;
    const auto add = [&](const auto& value) { line << ',' << value; };
    line << row.scene;
    add(row.group);
    row.value > 0.0 ? add(growth_value(row)) : add("");
    add(row.embree_stats.counts.at("triangles"));
    add(row.settings.spp);
    add(row.settings.width);
    add(row.settings.height);
    add(row.settings.shadow_res);
    const bool made = row.refusal.empty();
    made ? add(row.gnomon.wall.median) : add("");
    made ? add(row.gnomon.cpu.median) : add("");
    add(row.embree.wall.median);
    add(row.embree.cpu.median);
    add(row.build.segments);
    add(name_of(row.build.quality));
    add(name_of(row.rays.calls));
    add(name_of(row.rays.order));
    return line.str() + "\n";
}

}  // namespace

double growth_value(const Row& row) {
    if (row.group == "triangles") return static_cast<double>(row.embree_stats.counts.at("triangles"));
    if (row.group == "samples") return row.settings.spp;
    if (row.group == "texels") return row.settings.shadow_res;
    return row.value;
}

std::string to_csv(const std::vector<Row>& rows) {
    std::string text =
        "scene,group,value,triangles,spp,width,height,shadow_res,gnomon_wall_s,gnomon_cpu_s,embree_wall_s,embree_cpu_s,"
        "segments,quality,calls,order\n";
    for (const Row& row : rows) text += csv_line(row);
    return text;
}

Json to_json(const Context& context, const std::vector<Row>& rows) {
    Json json = {{"context", context_json(context, rows)}, {"benchmarks", Json::array()}};
    for (const Row& row : rows) {
        json["benchmarks"].push_back(gnomon_json(row));
        json["benchmarks"].push_back(embree_json(row));
    }
    return json;
}

}  // namespace gnomon::bench
