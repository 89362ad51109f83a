// SPDX-License-Identifier: Apache-2.0
// Rotations of the scene makers that need more than a line.
#include "geometry.hpp"

namespace gnomon::makers {

Quat look_rotation(Vec3 forward, Vec3 up) {
    const Vec3 z = normalized(forward) * -1.0;
    const Vec3 x = normalized(cross(up, z));
    const Vec3 y = cross(z, x);
    // The largest of the four components is found first, so that nothing small is divided by.
    const double trace = x.x + y.y + z.z;
    if (trace > 0.0) {
        const double s = 2.0 * std::sqrt(trace + 1.0);
        return {(y.z - z.y) / s, (z.x - x.z) / s, (x.y - y.x) / s, s / 4.0};
    }
    if (x.x > y.y && x.x > z.z) {
        const double s = 2.0 * std::sqrt(1.0 + x.x - y.y - z.z);
        return {s / 4.0, (y.x + x.y) / s, (z.x + x.z) / s, (y.z - z.y) / s};
    }
    if (y.y > z.z) {
        const double s = 2.0 * std::sqrt(1.0 + y.y - x.x - z.z);
        return {(y.x + x.y) / s, s / 4.0, (z.y + y.z) / s, (z.x - x.z) / s};
    }
    const double s = 2.0 * std::sqrt(1.0 + z.z - x.x - y.y);
    return {(z.x + x.z) / s, (z.y + y.z) / s, s / 4.0, (x.y - y.x) / s};
}

Quat slerp(Quat a, Quat b, double t) {
    double cosine = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
    const double sign = cosine < 0.0 ? -1.0 : 1.0;
    cosine *= sign;
    double wa = 1.0 - t, wb = t;
    if (cosine < 1.0 - 1e-9) {  // Nearer than this the linear weights are equal to the spherical ones in double.
        const double angle = std::acos(cosine);
        wa = std::sin(wa * angle) / std::sin(angle);
        wb = std::sin(wb * angle) / std::sin(angle);
    }
    wb *= sign;
    return {a.x * wa + b.x * wb, a.y * wa + b.y * wb, a.z * wa + b.z * wb, a.w * wa + b.w * wb};
}

}  // namespace gnomon::makers
