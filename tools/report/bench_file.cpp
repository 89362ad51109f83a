// SPDX-License-Identifier: Apache-2.0
// What `gnomon bench --json` has written.
#include "report/bench_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <gnomon/error.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "text/json_bounds.hpp"
#include "text/printable.hpp"
#include "text/read_text.hpp"

namespace gnomon::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kHint = "give what gnomon bench --json has written";
constexpr size_t kMostText = 4096, kMostName = 200, kMostCases = 4096, kMostAxes = 16, kMostValues = 256, kMostSide = 1024;
constexpr double kMostNumber = 1e15;

/// A part of the document and where it is, for complaints.
class Part {
public:
    Part(const Json& json, const std::string& file, std::string place) : json_(json), file_(file), place_(std::move(place)) {}

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorKind::input, fmt::format("{} {}", place_.empty() ? "the document" : place_, what), file_, kHint);
    }

    Part operator[](const std::string& name) const {
        need(json_.is_object(), "is not an object");
        const auto found = json_.find(name);
        need(found != json_.end(), fmt::format("has no \"{}\"", name));
        return {*found, file_, place_.empty() ? name : place_ + "." + name};
    }
    bool has(const std::string& name) const { return json_.is_object() && json_.contains(name); }
    bool is_null() const { return json_.is_null(); }

    /// Every element of an array.
    std::vector<Part> elements(size_t most) const {
        need(json_.is_array(), "is not an array");
        need(json_.size() <= most, fmt::format("has more than {} elements", most));
        std::vector<Part> parts;
        for (size_t i = 0; i < json_.size(); ++i) parts.emplace_back(json_[i], file_, fmt::format("{}[{}]", place_, i));
        return parts;
    }

    /// Every member of an object.
    std::vector<std::pair<std::string, Part>> members(size_t most) const {
        need(json_.is_object(), "is not an object");
        need(json_.size() <= most, fmt::format("has more than {} members", most));
        std::vector<std::pair<std::string, Part>> parts;
        for (const auto& [name, value] : json_.items())
            parts.emplace_back(checked(name, kMostName), Part(value, file_, place_ + "." + name));
        return parts;
    }

    std::string text(size_t most = kMostName) const {
        need(json_.is_string(), "is not a string");
        return checked(json_.get<std::string>(), most);
    }
    /// A string, or a number or truth as it is written.
    std::string value_text() const {
        if (json_.is_string()) return text();
        need(json_.is_number() || json_.is_boolean(), "is neither a string nor a number");
        return json_.dump();
    }
    bool truth() const {
        need(json_.is_boolean(), "is neither true nor false");
        return json_.get<bool>();
    }
    double number() const {
        need(json_.is_number(), "is not a number");
        const double value = json_.get<double>();
        need(std::isfinite(value) && std::abs(value) <= kMostNumber, fmt::format("is above {:g}", kMostNumber));
        return value;
    }
    double amount() const {
        const double value = number();
        need(value >= 0.0, "is below 0");
        return value;
    }
    uint64_t count() const {
        const double value = amount();
        need(value == std::floor(value), "is not a whole number");
        return static_cast<uint64_t>(value);
    }
    /// Nothing for null.
    std::optional<double> amount_or_null() const { return is_null() ? std::nullopt : std::optional(amount()); }

private:
    void need(bool fine, const std::string& what) const {
        if (!fine) fail(what);
    }
    std::string checked(const std::string& text, size_t most) const {
        need(text.size() <= most, fmt::format("has more than {} bytes", most));
        return printable(text);
    }

    const Json& json_;
    const std::string& file_;
    std::string place_;
};

Times times_of(const Part& part) {
    return {.median = part["median"].amount(),
            .q1 = part["q1"].amount(),
            .q3 = part["q3"].amount(),
            .least = part["least"].amount(),
            .samples = part["samples"].elements(1'000'000).size()};
}

std::vector<Lengths> lengths_of(const Part& part) {
    std::vector<Lengths> lengths;
    for (const Part& bin : part.elements(kMostValues)) {
        lengths.push_back({bin["from"].count(), bin["to"].count(), bin["lists"].count()});
        if (lengths.back().to < lengths.back().from) bin.fail("ends before it begins");
    }
    return lengths;
}

Texels texels_of(const Part& part) {
    const uint64_t width = part["width"].count(), height = part["height"].count();
    if (width < 1 || height < 1 || width > kMostSide || height > kMostSide)
        part.fail(fmt::format("is not from 1x1 to {0}x{0}", kMostSide));
    Texels texels{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
    const Part ranges = part["ranges"];
    for (const Part& texel : ranges.elements(kMostSide * kMostSide))
        texels.ranges.push_back(static_cast<uint32_t>(std::min(texel.amount(), 4e9)));
    if (texels.ranges.size() != width * height)
        ranges.fail(fmt::format("has {} numbers for {}x{}", texels.ranges.size(), width, height));
    return texels;
}

Case case_of(const Part& part, const std::vector<Axis>& axes) {
    Case c;
    c.name = part["name"].text();
    c.scene = part["scene"].text();
    c.layout = part["layout"].text();
    c.lossless = part["lossless"].truth();
    c.again = part["again"].truth();
    const Part values = part["axes"];
    for (const Axis& axis : axes) c.values.push_back(values[axis.name].value_text());
    for (const auto& [stage_name, stage] : part["stages"].members(kMostValues))
        if (!stage.is_null()) c.stages.emplace(stage_name, times_of(stage));
    if (!c.stages.contains("query")) part["stages"].fail("has no \"query\"");
    for (const auto& [count_name, number] : part["counts"].members(kMostValues))
        if (!number.is_null()) c.counts.emplace_back(count_name, number.number());
    if (part.has("lengths")) c.lengths = lengths_of(part["lengths"]);
    if (part.has("texels")) c.texels = texels_of(part["texels"]);
    if (part.has("same_picture")) c.same_picture = part["same_picture"].truth();
    if (part.has("floor")) c.copy_ms = part["floor"]["copy_ms"].amount_or_null();
    return c;
}

Verdict verdict_of(const Part& part) {
    const std::string text = part.text();
    for (const Verdict verdict : {Verdict::faster, Verdict::slower, Verdict::same, Verdict::undecided})
        if (text == to_string(verdict)) return verdict;
    part.fail(fmt::format("is \"{}\", not faster, slower, same or undecided", text));
}

Comparison comparison_of(const Part& part, const std::map<std::string, size_t>& by_name) {
    Comparison c;
    const std::string name = part["case"].text();
    const auto found = by_name.find(name);
    if (found == by_name.end()) part.fail(fmt::format("is of \"{}\", which is none of the cases", name));
    c.of = found->second;
    c.baseline = part["baseline"].text();
    c.stage = part["stage"].text();
    c.pairs = part["pairs"].count();
    c.ratio = part["ratio"].amount();
    c.low = part["low"].amount_or_null();
    c.high = part["high"].amount_or_null();
    c.verdict = verdict_of(part["verdict"]);
    return c;
}

std::vector<Axis> axes_of(const Part& part) {
    std::vector<Axis> axes;
    for (const Part& element : part.elements(kMostAxes)) {
        Axis axis{element["name"].text(), {}};
        for (const Part& value : element["values"].elements(kMostValues)) axis.values.push_back(value.value_text());
        // What is compared, and where: they have members of their own in each case.
        if (axis.name != "layout" && axis.name != "scene") axes.push_back(std::move(axis));
    }
    return axes;
}

void read_context(const Part& context, BenchFile& file) {
    const auto text = [&](const char* name) {
        return context.has(name) && !context[name].is_null() ? context[name].value_text() : std::string();
    };
    file.device = text("device");
    const std::pair<const char*, const char*> shown[] = {
        {"device", "device"}, {"driver", "driver"},  {"driver version", "driver_version"},
        {"date", "date"},     {"commit", "commit"},  {"gnomon", "gnomon_version"},
        {"seed", "seed"},     {"host", "host_name"}, {"CPU", "cpu"},
        {"CPUs", "num_cpus"}};
    for (const auto& [name, member] : shown)
        if (const std::string value = text(member); !value.empty()) file.context.emplace_back(name, value);
    if (context.has("command"))
        for (const Part& word : context["command"].elements(kMostCases))
            file.command += (file.command.empty() ? "" : " ") + word.text(kMostText);
}

}  // namespace

std::optional<double> Case::count(const std::string& of) const {
    const auto found = std::find_if(counts.begin(), counts.end(), [&](const auto& pair) { return pair.first == of; });
    return found == counts.end() ? std::nullopt : std::optional(found->second);
}

const Times* Case::stage(const std::string& of) const {
    const auto found = stages.find(of);
    return found == stages.end() ? nullptr : &found->second;
}

BenchFile read_bench_file(const std::filesystem::path& path) {
    BenchFile file;
    file.path = path.string();
    std::string reason;
    const std::optional<std::string> text = read_text(path, reason);
    if (!text) throw Error(ErrorKind::input, "cannot read the measurements: " + reason, file.path, kHint);
    check_json(*text, file.path, kHint);
    const Json json = Json::parse(*text);
    const Part document(json, file.path, "");
    const Part bench = document["gnomon"];
    if (const uint64_t format = bench["format"].count(); format != 1)
        throw Error(ErrorKind::input, fmt::format("gnomon.format is {}, and this gnomon reads 1", format), file.path,
                    "use a newer gnomon");
    read_context(document["context"], file);
    file.baseline = bench["baseline"].text();
    file.axes = axes_of(bench["axes"]);
    std::map<std::string, size_t> by_name;
    for (const Part& part : bench["cases"].elements(kMostCases)) {
        file.cases.push_back(case_of(part, file.axes));
        if (!by_name.emplace(file.cases.back().name, file.cases.size() - 1).second)
            part.fail(fmt::format("has the name of another, \"{}\"", file.cases.back().name));
    }
    for (const Part& part : bench["comparisons"].elements(kMostCases * 16))
        file.comparisons.push_back(comparison_of(part, by_name));
    for (const Part& part : bench["skipped"].elements(kMostCases))
        file.skipped.push_back({part["case"].text(), part["reason"].text(kMostText)});
    return file;
}

void label_files(std::vector<BenchFile>& files) {
    std::set<std::string> devices, stems;
    for (const BenchFile& file : files) {
        devices.insert(file.device);
        stems.insert(std::filesystem::path(file.path).stem().string());
    }
    const bool by_device = devices.size() == files.size() && !devices.contains(""), by_stem = stems.size() == files.size();
    for (BenchFile& file : files) {
        const std::filesystem::path path = file.path;
        file.label = by_device ? file.device : printable(by_stem ? path.stem().string() : file.path);
    }
}

}  // namespace gnomon::report
