// SPDX-License-Identifier: Apache-2.0
// Typed, checked reading of a JSON document: every complaint says where in the document it is.
#pragma once

#include <cstdint>
#include <functional>
#include <gnomon/error.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::gltf {

/// A value of a JSON document and the way to it from the root. A cursor points to its parent, so it lives no longer than that.
class Cursor {
public:
    /// The root. `file` starts every location.
    Cursor(const nlohmann::json& value, std::string_view file) : value_(&value), key_(file) {}

    const nlohmann::json& value() const { return *value_; }

    /// "scene.gltf: /nodes/3/mesh".
    std::string location() const;

    /// Throws ErrorKind::input with this location.
    [[noreturn]] void fail(const std::string& what, const std::string& hint = "repair or export the file again") const;

    /// The member `key` of this object, if it is there.
    std::optional<Cursor> find(std::string_view key) const;

    /// Likewise, an error where it is missing.
    Cursor get(std::string_view key) const;

    /// Element `i` of this array.
    Cursor at(size_t i) const { return Cursor((*value_)[i], this, {}, i); }

    /// Calls f with each element of the array `key` and its index. A missing array has no elements.
    void for_each(std::string_view key, const std::function<void(const Cursor&, size_t)>& f) const;

    /// The number of elements of the array `key`; 0 where it is missing.
    size_t count(std::string_view key) const;

    void require_object() const;
    void require_array() const;

    /// This value as an integer between `least` and `most`.
    uint64_t integer(uint64_t least = 0, uint64_t most = std::numeric_limits<uint64_t>::max()) const;
    /// This value as a finite number that a 32-bit float can hold.
    double number() const;
    const std::string& string() const;
    bool boolean() const;
    /// This value as an array of finite numbers; `size`: how many there must be, 0: any number.
    std::vector<double> numbers(size_t size = 0) const;

    /// The integer member `key`, or `fallback` where it is missing.
    uint64_t integer_or(std::string_view key, uint64_t fallback, uint64_t least = 0,
                        uint64_t most = std::numeric_limits<uint64_t>::max()) const;
    double number_or(std::string_view key, double fallback) const;

    /// The member `key` as an index below `count`; none where it is missing. `things`: what it counts ("accessors").
    std::optional<size_t> index(std::string_view key, size_t count, std::string_view things) const;
    /// This value as an index below `count`.
    size_t as_index(size_t count, std::string_view things) const;

private:
    Cursor(const nlohmann::json& value, const Cursor* parent, std::string_view key, size_t element)
        : value_(&value), parent_(parent), key_(key), element_(element) {}

    const nlohmann::json* value_;
    const Cursor* parent_ = nullptr;
    std::string_view key_;  // Empty for an element of an array.
    size_t element_ = 0;
};

}  // namespace gnomon::gltf
