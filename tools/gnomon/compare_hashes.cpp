// SPDX-License-Identifier: Apache-2.0
// Whether images are the same, bit for bit.
#include <algorithm>
#include <gnomon/error.hpp>
#include <set>

#include "command.hpp"
#include "compare.hpp"
#include "image_errors.hpp"
#include "io/image_hash.hpp"

namespace gnomon::cli {

namespace {

/// The channels of the image that were asked for; all, if none were.
std::vector<Channel> chosen(NamedImage image, const std::vector<std::string>& names) {
    if (names.empty()) return std::move(image.image.channels);
    std::vector<Channel> channels;
    for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
        const Channel* channel = image.image.find(name);
        if (channel == nullptr)
            throw Error(ErrorKind::input, "there is no channel '" + name + "'", image.path,
                        "see 'gnomon compare A A' for those it has");
        channels.push_back(*channel);
    }
    return channels;
}

}  // namespace

int compare_hashes(const CompareOptions& options) {
    io::Json json = io::document("hashes");
    json["channels"] = options.channels.empty() ? io::Json(nullptr) : io::Json(options.channels);
    json["files"] = io::Json::array();
    std::set<uint64_t> hashes;
    for (const std::string& path : options.files) {
        const NamedImage image = read_image(path);
        const uint64_t hash = io::image_hash(image.image.width, image.image.height, chosen(image, options.channels));
        hashes.insert(hash);
        json["files"].push_back({{"path", path}, {"hash", io::hash_text(hash)}});
        if (options.json != "-") print_line(io::hash_text(hash) + "  " + path);
    }
    json["same"] = hashes.size() == 1;
    if (!options.json.empty()) write_json(options.json, json);
    return hashes.size() == 1 ? kDone : kOverThreshold;
}

}  // namespace gnomon::cli
