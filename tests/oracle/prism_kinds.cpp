// SPDX-License-Identifier: Apache-2.0
// Prisms to test with: made around the origin of the image, then moved so that a random point of theirs meets the texel.
#include "oracle/prism_kinds.hpp"

#include <cmath>

namespace gnomon::oracle {
namespace {

/// Where each vertex is in the image and how deep, at both keys.
struct Shape {
    std::array<glm::dvec2, 3> start, end;
    std::array<double, 3> start_w{1.0, 1.0, 1.0}, end_w{1.0, 1.0, 1.0};
};

class Maker {
public:
    explicit Maker(std::mt19937& random) : random_(random) {}

    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    double power_of_two(double low, double high) { return std::exp2(uniform(low, high)); }
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    glm::dvec2 somewhere() {
        std::normal_distribution<double> normal;
        const double x = normal(random_);
        return {x, normal(random_)};
    }

    Shape moving(double size, double motion) {
        Shape shape;
        const glm::dvec2 way = motion * somewhere();
        for (size_t i = 0; i < 3; ++i) {
            shape.start[i] = size * somewhere();
            shape.end[i] = shape.start[i] + way + 0.3 * size * somewhere();
        }
        return shape;
    }

    Shape grazing() {
        Shape shape;
        const double size = power_of_two(0, 8), height = size * power_of_two(-24, -3);
        const glm::dvec2 along = somewhere(), way = power_of_two(-6, 4) * somewhere();
        const glm::dvec2 across(-along.y, along.x), turned = along + 0.01 * uniform(-1, 1) * across;
        for (size_t i = 0; i < 3; ++i) {
            const double x = size * uniform(-1, 1);
            shape.start[i] = x * along + height * uniform(-1, 1) * across;
            shape.end[i] = x * turned + height * uniform(-1, 1) * across + way;
        }
        return shape;
    }

    Shape degenerate() {
        Shape shape = moving(power_of_two(-1, 5), power_of_two(-2, 6));
        switch (whole(0, 4)) {
            case 0:  // Two vertices are one.
                shape.start[1] = shape.start[0];
                shape.end[1] = shape.end[0];
                break;
            case 1:  // All are one.
                shape.start[1] = shape.start[2] = shape.start[0];
                shape.end[1] = shape.end[2] = shape.end[0];
                break;
            case 2:  // On a line.
                shape.start = {glm::dvec2(0, 0), glm::dvec2(2, 4), glm::dvec2(4, 8)};
                shape.end = {glm::dvec2(3, 0), glm::dvec2(5, 4), glm::dvec2(7, 8)};
                break;
            case 3:
                shape.start[1] = shape.start[0];
                break;  // At the start only.
            default:
                shape.end[2] = shape.end[0];
                break;  // At the end only.
        }
        return shape;
    }

    Shape on_borders() {
        Shape shape;
        for (auto* key : {&shape.start, &shape.end}) {
            for (glm::dvec2& p : *key) p = glm::dvec2(whole(-6, 6), whole(-6, 6));
        }
        return shape;
    }

    Shape shape_of(PrismKind kind) {
        switch (kind) {
            case PrismKind::grazing:
                return grazing();
            case PrismKind::degenerate:
                return degenerate();
            case PrismKind::turning: {
                Shape shape = moving(power_of_two(-1, 5), power_of_two(-2, 5));
                std::swap(shape.end[0], shape.end[1]);
                return shape;
            }
            case PrismKind::sub_texel:
                return moving(power_of_two(-12, -1), power_of_two(-8, 3));
            case PrismKind::huge:
                return moving(1e4 * uniform(0.2, 1.0), power_of_two(0, 12));
            case PrismKind::fast:
                return moving(power_of_two(0, 5), power_of_two(8, 13.3));
            case PrismKind::on_borders:
                return on_borders();
            default:
                return moving(power_of_two(-1, 5), power_of_two(-2, 6));
        }
    }

    void add_depths(Shape& shape, PrismKind kind) {
        const double scale = power_of_two(-3, 10);
        if (kind == PrismKind::on_borders) {
            for (auto* key : {&shape.start_w, &shape.end_w}) {
                for (double& w : *key) w = std::exp2(whole(-2, 6));
            }
            return;
        }
        for (size_t i = 0; i < 3; ++i) {
            shape.start_w[i] = scale * power_of_two(-1, 1);
            shape.end_w[i] = shape.start_w[i] * power_of_two(-0.5, 0.5);
        }
        if (kind == PrismKind::crossing_eye) {
            for (auto* key : {&shape.start_w, &shape.end_w}) {
                for (double& w : *key) w *= whole(0, 2) == 0 ? -uniform(0.0, 1.0) : 1.0;
            }
        }
        if (kind == PrismKind::behind) {
            for (size_t i = 0; i < 3; ++i) {
                shape.start_w[i] = -shape.start_w[i];
                shape.end_w[i] = -shape.end_w[i];
            }
        }
    }

    /// A point of the image that it covers at some time; the origin where there is none.
    glm::dvec2 covered_point(const Shape& shape) {
        const double s = uniform(0, 1), u = uniform(0, 1), v = uniform(0, 1 - u);
        const std::array<double, 3> share = {1 - u - v, u, v};
        glm::dvec3 sum(0.0);
        for (size_t i = 0; i < 3; ++i) {
            sum += share[i] * (1 - s) * shape.start_w[i] * glm::dvec3(shape.start[i], 1.0);
            sum += share[i] * s * shape.end_w[i] * glm::dvec3(shape.end[i], 1.0);
        }
        return sum.z > 0.0 ? glm::dvec2(sum.x, sum.y) / sum.z : glm::dvec2(0.0);
    }

private:
    std::mt19937& random_;
};

}  // namespace

const char* name_of(PrismKind kind) {
    constexpr std::array<const char*, kPrismKinds> kNames = {"random",     "grazing", "degenerate", "crossing_eye",
                                                             "behind",     "turning", "sub_texel",  "huge",
                                                             "motionless", "fast",    "on_borders"};
    return kNames[static_cast<size_t>(kind)];
}

Prism make_prism(PrismKind kind, bool orthographic, const glm::dvec2& texel, std::mt19937& random) {
    Maker maker(random);
    Shape shape = maker.shape_of(kind);
    if (!orthographic) maker.add_depths(shape, kind);
    if (kind == PrismKind::motionless) {
        shape.end = shape.start;
        shape.end_w = shape.start_w;
    }
    glm::dvec2 shift = texel;
    if (kind != PrismKind::on_borders)
        shift += glm::dvec2(maker.uniform(-0.2, 1.2), maker.uniform(-0.2, 1.2)) - maker.covered_point(shape);
    Prism prism;
    for (size_t i = 0; i < 3; ++i) {
        const auto homogeneous = [&](const glm::dvec2& p, double w) {
            const double z = orthographic ? maker.uniform(1.0, 100.0) : -1.0;
            return glm::vec4(glm::dvec4(w * (p + shift), z, w));
        };
        prism.start[i] = homogeneous(shape.start[i], shape.start_w[i]);
        prism.end[i] = homogeneous(shape.end[i], shape.end_w[i]);
        if (kind == PrismKind::motionless) prism.end[i] = prism.start[i];
    }
    return prism;
}

MovingTriangle exact(const Prism& prism) {
    MovingTriangle triangle;
    for (size_t i = 0; i < 3; ++i) {
        triangle.start[i] = glm::dvec4(prism.start[i]);
        triangle.end[i] = glm::dvec4(prism.end[i]);
    }
    return triangle;
}

}  // namespace gnomon::oracle
