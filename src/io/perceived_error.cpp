// SPDX-License-Identifier: Apache-2.0
#include "io/perceived_error.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "io/png.hpp"

namespace gnomon::io {
namespace {

using Triple = std::array<double, 3>;
using Plane = std::vector<double>;

constexpr double kPi = std::numbers::pi;

// sRGB primaries, D65 (IEC 61966-2-1).
constexpr double kToXyz[3][3] = {{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};

Triple times(const double (&m)[3][3], const Triple& v) {
    Triple result{};
    for (size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return result;
}

Triple solve(const double (&m)[3][3], const Triple& v) {
    const auto minor = [&](size_t r0, size_t r1, size_t c0, size_t c1) {
        return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    };
    const double c[3] = {minor(1, 2, 1, 2), -minor(1, 2, 0, 2), minor(1, 2, 0, 1)};
    const double determinant = m[0][0] * c[0] + m[0][1] * c[1] + m[0][2] * c[2];
    const double inverse[3][3] = {{c[0], -minor(0, 2, 1, 2), minor(0, 1, 1, 2)},
                                  {c[1], minor(0, 2, 0, 2), -minor(0, 1, 0, 2)},
                                  {c[2], -minor(0, 2, 0, 1), minor(0, 1, 0, 1)}};
    Triple result = times(inverse, v);
    for (double& x : result) x /= determinant;
    return result;
}

const Triple kWhite = times(kToXyz, {1.0, 1.0, 1.0});

// Of white's: X / Xn, Y / Yn, Z / Zn.
Triple relative_xyz(const Triple& rgb) {
    Triple xyz = times(kToXyz, rgb);
    for (size_t i = 0; i < 3; ++i) xyz[i] /= kWhite[i];
    return xyz;
}

// The opponent space in which eyes filter: linear, hence not CIELAB.
Triple to_ycxcz(const Triple& rgb) {
    const Triple r = relative_xyz(rgb);
    return {116.0 * r[1] - 16.0, 500.0 * (r[0] - r[1]), 200.0 * (r[1] - r[2])};
}

Triple from_ycxcz(const Triple& c) {
    const double y = (c[0] + 16.0) / 116.0;
    return solve(kToXyz, {(c[1] / 500.0 + y) * kWhite[0], y * kWhite[1], (y - c[2] / 200.0) * kWhite[2]});
}

Triple to_lab(const Triple& rgb) {
    constexpr double kDelta = 6.0 / 29.0;
    Triple f = relative_xyz(rgb);
    for (double& t : f) t = t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

// Colours differ less where it is dark (Hunt).
Triple hunt(const Triple& lab) { return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]}; }

double hyab(const Triple& a, const Triple& b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

// Rows with one kernel, columns with another; beyond the picture its edge goes on.
Plane convolve(const Plane& plane, uint32_t width, uint32_t height, const Plane& along_x, const Plane& along_y) {
    const auto pass = [](const Plane& from, int64_t lines, int64_t length, int64_t line_step, int64_t step,
                         const Plane& kernel) {
        Plane to(from.size());
        const auto radius = static_cast<int64_t>(kernel.size() / 2);
        for (int64_t line = 0; line < lines; ++line) {
            for (int64_t i = 0; i < length; ++i) {
                double sum = 0.0;
                for (int64_t k = -radius; k <= radius; ++k) {
                    const int64_t at = std::clamp<int64_t>(i + k, 0, length - 1);
                    sum += kernel[static_cast<size_t>(k + radius)] * from[static_cast<size_t>(line * line_step + at * step)];
                }
                to[static_cast<size_t>(line * line_step + i * step)] = sum;
            }
        }
        return to;
    };
    return pass(pass(plane, height, width, width, 1, along_x), width, height, 1, width, along_y);
}

template <class Value>
Plane kernel_of(int radius, Value value) {
    Plane kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(value(static_cast<double>(i)));
    return kernel;
}

double sum_of(const Plane& values) {
    double sum = 0.0;
    for (const double v : values) sum += v;
    return sum;
}

// Contrast sensitivity: a sum of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees (table 1).
struct Gaussian {
    double a, b;
};

Plane filter_contrast(const Plane& plane, uint32_t width, uint32_t height, const std::vector<Gaussian>& gaussians,
                      double pixels_per_degree) {
    constexpr double kWidest = 0.04;  // All three filters are as wide as the widest needs.
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(kWidest / (2.0 * kPi * kPi)) * pixels_per_degree));
    Plane result(plane.size(), 0.0);
    double total = 0.0;
    for (const Gaussian& g : gaussians) {
        const Plane kernel = kernel_of(radius, [&](double x) {
            const double degrees = x / pixels_per_degree;
            return std::exp(-kPi * kPi * degrees * degrees / g.b);
        });
        const double weight = g.a * std::sqrt(kPi / g.b);
        total += weight * sum_of(kernel) * sum_of(kernel);
        const Plane filtered = convolve(plane, width, height, kernel, kernel);
        for (size_t i = 0; i < result.size(); ++i) result[i] += weight * filtered[i];
    }
    for (double& v : result) v /= total;
    return result;
}

// As seen from the distance, in CIELAB with the colours of the dark pulled together.
std::vector<Triple> perceived(const ShownPicture& picture, const std::array<Plane, 3>& ycxcz, double pixels_per_degree) {
    const std::vector<Gaussian> filters[3] = {{{1.0, 0.0047}}, {{1.0, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}};
    std::array<Plane, 3> filtered;
    for (size_t c = 0; c < 3; ++c)
        filtered[c] = filter_contrast(ycxcz[c], picture.width, picture.height, filters[c], pixels_per_degree);
    std::vector<Triple> result;
    for (size_t i = 0; i < filtered[0].size(); ++i) {
        Triple rgb = from_ycxcz({filtered[0][i], filtered[1][i], filtered[2][i]});
        for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
        result.push_back(hunt(to_lab(rgb)));
    }
    return result;
}

// The first or second derivative of a Gaussian, what is positive and what is negative in it summing to 1 each.
Plane derivative_kernel(double sigma, int radius, bool second) {
    Plane kernel = kernel_of(radius, [&](double x) {
        const double g = std::exp(-x * x / (2.0 * sigma * sigma));
        return second ? (x * x / (sigma * sigma) - 1.0) * g : -x * g;
    });
    double positive = 0.0, negative = 0.0;
    for (const double v : kernel) (v > 0.0 ? positive : negative) += v;
    for (double& v : kernel) v /= v > 0.0 ? positive : -negative;
    return kernel;
}

struct Features {
    Plane edges, points;
};

Features features_of(const Plane& ycxcz_y, uint32_t width, uint32_t height, double pixels_per_degree) {
    constexpr double kFeatureDegrees = 0.082;
    const double sigma = 0.5 * kFeatureDegrees * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    Plane smooth = kernel_of(radius, [&](double x) { return std::exp(-x * x / (2.0 * sigma * sigma)); });
    const double sum = sum_of(smooth);
    for (double& v : smooth) v /= sum;
    Plane y = ycxcz_y;
    for (double& v : y) v = (v + 16.0) / 116.0;
    const auto magnitude = [&](bool second) {
        const Plane kernel = derivative_kernel(sigma, radius, second);
        Plane x_part = convolve(y, width, height, kernel, smooth);
        const Plane y_part = convolve(y, width, height, smooth, kernel);
        for (size_t i = 0; i < x_part.size(); ++i) x_part[i] = std::hypot(x_part[i], y_part[i]);
        return x_part;
    };
    return {magnitude(false), magnitude(true)};
}

std::array<Plane, 3> planes_ycxcz(const ShownPicture& picture) {
    std::array<Plane, 3> planes;
    for (size_t i = 0; i < picture.rgb[0].size(); ++i) {
        const Triple c = to_ycxcz({picture.rgb[0][i], picture.rgb[1][i], picture.rgb[2][i]});
        for (size_t k = 0; k < 3; ++k) planes[k].push_back(c[k]);
    }
    return planes;
}

Plane luma_of(const ShownPicture& p) {
    Plane luma;
    for (size_t i = 0; i < p.rgb[0].size(); ++i)
        luma.push_back(0.2126 * srgb_encoded(p.rgb[0][i]) + 0.7152 * srgb_encoded(p.rgb[1][i]) +
                       0.0722 * srgb_encoded(p.rgb[2][i]));
    return luma;
}

}  // namespace

std::optional<ShownPicture> shown_picture(std::span<const Channel> channels, uint32_t width, uint32_t height,
                                          double exposure_ev) {
    ShownPicture picture{width, height, {}, 0};
    const double scale = std::exp2(exposure_ev);
    for (size_t c = 0; c < 3; ++c) {
        const auto found = std::find_if(channels.begin(), channels.end(),
                                        [&](const Channel& channel) { return channel.name == std::string(1, "RGB"[c]); });
        if (found == channels.end()) return std::nullopt;
        for (const float v : found->values) {
            picture.not_finite += std::isfinite(v) ? 0 : 1;
            picture.rgb[c].push_back(std::isfinite(v) ? std::clamp(v * scale, 0.0, 1.0) : 0.0);
        }
    }
    return picture;
}

std::vector<double> flip(const ShownPicture& test, const ShownPicture& reference, double pixels_per_degree) {
    assert(test.width == reference.width && test.height == reference.height);
    constexpr double kColorPower = 0.7, kKnee = 0.4, kKneeValue = 0.95, kFeaturePower = 0.5;
    const uint32_t width = test.width, height = test.height;
    const std::array<Plane, 3> opponents = planes_ycxcz(test), opponents_reference = planes_ycxcz(reference);
    const std::vector<Triple> seen = perceived(test, opponents, pixels_per_degree);
    const std::vector<Triple> seen_reference = perceived(reference, opponents_reference, pixels_per_degree);
    const Features features = features_of(opponents[0], width, height, pixels_per_degree);
    const Features features_reference = features_of(opponents_reference[0], width, height, pixels_per_degree);

    // The largest difference of colours is that of green and blue; most of the range is for differences below the knee.
    const double largest = std::pow(hyab(hunt(to_lab({0.0, 1.0, 0.0})), hunt(to_lab({0.0, 0.0, 1.0}))), kColorPower);
    const double knee = kKnee * largest;
    std::vector<double> result;
    for (size_t i = 0; i < seen.size(); ++i) {
        const double color = std::pow(hyab(seen[i], seen_reference[i]), kColorPower);
        const double color_error =
            color < knee ? kKneeValue / knee * color : kKneeValue + (color - knee) / (largest - knee) * (1.0 - kKneeValue);
        const double feature = std::max(std::abs(features.edges[i] - features_reference.edges[i]),
                                        std::abs(features.points[i] - features_reference.points[i]));
        const double feature_error = std::clamp(std::pow(feature / std::numbers::sqrt2, kFeaturePower), 0.0, 1.0);
        result.push_back(std::pow(std::clamp(color_error, 0.0, 1.0), 1.0 - feature_error));
    }
    return result;
}

double ssim(const ShownPicture& a, const ShownPicture& b) {
    assert(a.width == b.width && a.height == b.height);
    constexpr double kSigma = 1.5, kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
    const int radius = std::min(5, static_cast<int>(std::min(a.width, a.height) - 1) / 2);
    Plane window = kernel_of(radius, [&](double x) { return std::exp(-x * x / (2.0 * kSigma * kSigma)); });
    const double sum = sum_of(window);
    for (double& v : window) v /= sum;
    const Plane x = luma_of(a), y = luma_of(b);
    const auto mean_of_products = [&](const Plane& p, const Plane& q) {
        Plane products(p.size());
        for (size_t i = 0; i < p.size(); ++i) products[i] = p[i] * q[i];
        return convolve(products, a.width, a.height, window, window);
    };
    const Plane mx = convolve(x, a.width, a.height, window, window), my = convolve(y, a.width, a.height, window, window);
    const Plane xx = mean_of_products(x, x), yy = mean_of_products(y, y), xy = mean_of_products(x, y);
    double total = 0.0;
    uint64_t count = 0;
    const auto margin = static_cast<uint32_t>(radius);
    for (uint32_t row = margin; row + margin < a.height; ++row) {
        for (uint32_t column = margin; column + margin < a.width; ++column) {
            const size_t i = size_t(row) * a.width + column;
            const double vx = xx[i] - mx[i] * mx[i], vy = yy[i] - my[i] * my[i], cov = xy[i] - mx[i] * my[i];
            total +=
                (2.0 * mx[i] * my[i] + kC1) * (2.0 * cov + kC2) / ((mx[i] * mx[i] + my[i] * my[i] + kC1) * (vx + vy + kC2));
            ++count;
        }
    }
    return total / static_cast<double>(count);
}

}  // namespace gnomon::io
