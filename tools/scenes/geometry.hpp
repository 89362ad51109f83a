// SPDX-License-Identifier: Apache-2.0
// Vectors and rotations in double for the scene makers. Plain arithmetic of our own, so that the bytes of the scenes do not
// depend on the version of a library.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace gnomon::makers {

inline constexpr double kPi = std::numbers::pi;

struct Vec3 {
    double x = 0.0, y = 0.0, z = 0.0;
    bool operator==(const Vec3&) const = default;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
/// The zero vector stays zero.
inline Vec3 normalized(Vec3 a) {
    const double l = length(a);
    return l > 0.0 ? a * (1.0 / l) : a;
}

/// A unit quaternion, in glTF's order.
struct Quat {
    double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};

/// Rotation by `angle` radians about a unit `axis`.
inline Quat axis_angle(Vec3 axis, double angle) {
    const double s = std::sin(angle / 2.0);
    return {axis.x * s, axis.y * s, axis.z * s, std::cos(angle / 2.0)};
}
inline Quat operator*(Quat a, Quat b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
inline Quat conjugate(Quat q) { return {-q.x, -q.y, -q.z, q.w}; }
inline Vec3 rotate(Quat q, Vec3 v) {
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = cross(u, v) * 2.0;
    return v + t * q.w + cross(u, t);
}

/// The rotation that turns -Z to `forward` and keeps +Y as near to `up` as it can: how cameras and lights are aimed.
/// `forward` and `up` are not parallel.
Quat look_rotation(Vec3 forward, Vec3 up);

/// Spherical interpolation along the shorter arc, as glTF's LINEAR does for rotations.
Quat slerp(Quat a, Quat b, double t);

/// A 64-bit linear congruential generator with an output permutation; the same numbers everywhere.
class Rng {
public:
    explicit Rng(uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 0x632be59bd9b4e019u) {}
    /// In [0, 1), a multiple of 2^-32.
    double unit() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        uint64_t mixed = state_ ^ (state_ >> 33);
        mixed *= 0xff51afd7ed558ccdu;
        return static_cast<double>((mixed ^ (mixed >> 29)) >> 32) * 0x1p-32;
    }
    double in(double low, double high) { return low + (high - low) * unit(); }
    /// Uniform on the unit sphere.
    Vec3 direction() {
        const double z = in(-1.0, 1.0), a = in(0.0, 2.0 * kPi), r = std::sqrt(1.0 - z * z);
        return {r * std::cos(a), r * std::sin(a), z};
    }

private:
    uint64_t state_;
};

}  // namespace gnomon::makers
