// SPDX-License-Identifier: Apache-2.0
// Typed, checked reading of a JSON document.
#include "scene/json_cursor.hpp"

#include <cmath>
#include <limits>

namespace gnomon::gltf {

using nlohmann::json;

std::string Cursor::location() const {
    if (parent_ == nullptr) return std::string(key_);
    const std::string separator = parent_->parent_ == nullptr ? ": /" : "/";
    return parent_->location() + separator + (key_.empty() ? std::to_string(element_) : std::string(key_));
}

void Cursor::fail(const std::string& what, const std::string& hint) const {
    throw Error(ErrorKind::input, what, "in " + location(), hint);
}

void Cursor::require_object() const {
    if (!value_->is_object()) fail("an object is expected");
}

void Cursor::require_array() const {
    if (!value_->is_array()) fail("an array is expected");
}

std::optional<Cursor> Cursor::find(std::string_view key) const {
    require_object();
    const auto it = value_->find(key);
    if (it == value_->end()) return std::nullopt;
    return Cursor(*it, this, key, 0);
}

Cursor Cursor::get(std::string_view key) const {
    const std::optional<Cursor> member = find(key);
    if (!member) fail("'" + std::string(key) + "' is missing");
    return *member;
}

void Cursor::for_each(std::string_view key, const std::function<void(const Cursor&, size_t)>& f) const {
    const std::optional<Cursor> array = find(key);
    if (!array) return;
    array->require_array();
    size_t i = 0;
    for (const json& element : array->value()) {
        f(Cursor(element, &*array, {}, i), i);
        ++i;
    }
}

size_t Cursor::count(std::string_view key) const {
    const std::optional<Cursor> array = find(key);
    if (!array) return 0;
    array->require_array();
    return array->value().size();
}

uint64_t Cursor::integer(uint64_t least, uint64_t most) const {
    if (!value_->is_number_unsigned()) fail("a whole number that is not negative is expected");
    const uint64_t number = value_->get<uint64_t>();
    if (number < least || number > most) {
        fail(std::to_string(number) + " is not between " + std::to_string(least) + " and " + std::to_string(most));
    }
    return number;
}

double Cursor::number() const {
    if (!value_->is_number()) fail("a number is expected");
    const double number = value_->get<double>();
    if (!std::isfinite(number)) fail("the number is not finite");
    if (std::abs(number) > double{std::numeric_limits<float>::max()})
        fail("the number is larger than a 32-bit float can hold, 3.4e38");
    return number;
}

const std::string& Cursor::string() const {
    if (!value_->is_string()) fail("a string is expected");
    return value_->get_ref<const std::string&>();
}

bool Cursor::boolean() const {
    if (!value_->is_boolean()) fail("true or false is expected");
    return value_->get<bool>();
}

std::vector<double> Cursor::numbers(size_t size) const {
    require_array();
    if (size != 0 && value_->size() != size) {
        fail(std::to_string(size) + " numbers are expected, there are " + std::to_string(value_->size()));
    }
    std::vector<double> result;
    result.reserve(value_->size());
    for (size_t i = 0; i < value_->size(); ++i) result.push_back(at(i).number());
    return result;
}

uint64_t Cursor::integer_or(std::string_view key, uint64_t fallback, uint64_t least, uint64_t most) const {
    const std::optional<Cursor> member = find(key);
    return member ? member->integer(least, most) : fallback;
}

double Cursor::number_or(std::string_view key, double fallback) const {
    const std::optional<Cursor> member = find(key);
    return member ? member->number() : fallback;
}

std::optional<size_t> Cursor::index(std::string_view key, size_t count, std::string_view things) const {
    const std::optional<Cursor> member = find(key);
    if (!member) return std::nullopt;
    return member->as_index(count, things);
}

size_t Cursor::as_index(size_t count, std::string_view things) const {
    const uint64_t number = integer();
    if (number >= count) {
        fail("index " + std::to_string(number) + " is out of range: there are " + std::to_string(count) + " " +
             std::string(things));
    }
    return static_cast<size_t>(number);
}

}  // namespace gnomon::gltf
