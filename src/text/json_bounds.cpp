// SPDX-License-Identifier: Apache-2.0
#include "text/json_bounds.hpp"

#include <gnomon/error.hpp>
#include <nlohmann/json.hpp>

namespace gnomon {

using nlohmann::json;

namespace {

constexpr int kMostLevels = 64;
constexpr size_t kMostObjects = 500'000;
constexpr size_t kMostValues = 8'000'000;

// Counts what the text holds without building it. A callback of the DOM parser could count, too, but makes that parser
// quadratic (nlohmann-json 3.11.2 looks for discarded values in the whole parent after every object).
class BoundScan : public nlohmann::json_sax<json> {
public:
    BoundScan(const std::string& where, const std::string& hint) : where_(where), hint_(hint) {}

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t&) override { return value(); }
    bool string(string_t&) override { return value(); }
    bool binary(binary_t&) override { return value(); }
    bool key(string_t&) override { return value(); }
    bool start_object(std::size_t) override {
        if (++objects_ > kMostObjects) fail("the JSON text has more than " + std::to_string(kMostObjects) + " objects");
        return deeper();
    }
    bool end_object() override { return shallower(); }
    bool start_array(std::size_t) override { return deeper(); }
    bool end_array() override { return shallower(); }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& e) override {
        fail("the file is not valid JSON (" + std::string(e.what()) + ")");
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw Error(ErrorKind::input, what, where_, hint_); }

    bool value() {
        if (++values_ > kMostValues) fail("the JSON text has more than " + std::to_string(kMostValues) + " values");
        return true;
    }
    bool deeper() {
        if (++levels_ > kMostLevels) fail("the JSON text is nested more than " + std::to_string(kMostLevels) + " deep");
        return value();
    }
    bool shallower() {
        --levels_;
        return true;
    }

    const std::string& where_;
    const std::string& hint_;
    int levels_ = 0;
    size_t objects_ = 0;
    size_t values_ = 0;
};

}  // namespace

void check_json(std::string_view text, const std::string& where, const std::string& hint) {
    BoundScan scan(where, hint);
    json::sax_parse(text, &scan);
}

}  // namespace gnomon
