// SPDX-License-Identifier: Apache-2.0
// The scene tree: leaf cards under a moving light, after that of Andersson et al. 2015 (Fig. 14).
#include "common.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

constexpr Vec3 kUp{0, 1, 0};

/// A unit vector at `angle` from the unit vector `axis`, in a random direction around it.
Vec3 leaning(Rng& rng, Vec3 axis, double angle) {
    const Vec3 across = normalized(cross(axis, rng.direction()));
    return axis * std::cos(angle) + across * std::sin(angle);
}

struct Branch {
    Vec3 from, direction;
    double length, radius;
    int level;       ///< 0 for the trunk.
    uint16_t joint;  ///< 0 for the trunk, then one for each limb that grows out of it.
};

class Tree {
public:
    explicit Tree(uint32_t seed) : rng_(seed) { grow({{0, -0.1, 0}, kUp, 2.9, 0.2, 0, 0}); }

    /// Kites that are folded along the middle, on twigs in turn.
    Mesh leaves(uint32_t count, double length) {
        Mesh mesh;
        for (uint32_t i = 0; i < count; ++i) {
            const Twig& twig = twigs_[i % twigs_.size()];
            const Vec3 at = twig.from + (twig.to - twig.from) * rng_.in(0.1, 1.05);
            const Vec3 axis = leaning(rng_, normalized(twig.to - twig.from), rng_.in(0.5, 1.4));
            // Leaves face upward more than downward.
            const Vec3 side = normalized(cross(axis, rng_.direction() * 0.7 + kUp)), face = cross(side, axis);
            const double size = length * rng_.in(0.7, 1.2);
            const Vec3 stalk = at + axis * (0.2 * size), middle = stalk + axis * (0.45 * size) + face * (0.08 * size);
            Mesh leaf;
            leaf.positions = {stalk, middle + side * (0.3 * size), stalk + axis * size, middle - side * (0.3 * size)};
            leaf.indices = {0, 1, 2, 0, 2, 3};
            leaf.smooth_normals();
            const double age = rng_.unit() * rng_.unit();
            leaf.paint(bytes_of({0.1 + 0.34 * age, 0.3 + 0.12 * age, 0.04 + 0.02 * age}));
            leaf.bind(twig.joint);
            mesh.append(leaf);
        }
        return mesh;
    }

    const Mesh& branches() const { return branches_; }
    const std::vector<Vec3>& joints() const { return joints_; }

private:
    struct Twig {
        Vec3 from, to;
        uint16_t joint;
    };

    void grow(const Branch& branch) {
        static constexpr uint32_t kSides[] = {16, 10, 7, 5}, kRings[] = {14, 10, 7, 4};
        static constexpr int kChildren[] = {9, 7, 5, 0};
        static constexpr double kShrink[] = {0.78, 0.62, 0.6}, kAngle[] = {0.85, 0.7, 0.75};
        const int level = branch.level;
        const Vec3 side = normalized(cross(branch.direction, {0.31, 0.22, 0.93})), front = cross(branch.direction, side);
        const Vec3 bend = leaning(rng_, branch.direction, kPi / 2.0) * (0.12 * branch.length) +
                          kUp * (level == 0 ? 0.0 : 0.12 * branch.length);
        const auto at = [&](double share) {
            return branch.from + branch.direction * (branch.length * share) + bend * (share * share);
        };
        std::vector<Ring> rings;
        for (uint32_t r = 0; r < kRings[level]; ++r) {
            const double share = static_cast<double>(r) / kRings[level];
            const double roots = level == 0 ? 0.7 * std::exp(-12.0 * share) : 0.0;
            const double width = branch.radius * (1.0 - 0.7 * share + roots);
            rings.push_back({at(share), side * width, front * width});
        }
        Mesh wood = tube(at(0.0), rings, at(1.0), kSides[level]);
        wood.paint(bytes_of(from_srgb(116, 88, 66)));
        wood.bind(branch.joint);
        branches_.append(wood);
        if (level == 0) joints_.push_back({});
        if (level == 3) {
            twigs_.push_back({at(0.0), at(1.0), branch.joint});
            return;
        }
        for (int child = 0; child < kChildren[level]; ++child) {
            const double first = level == 0 ? 0.5 : 0.3;
            const double share = first + (1.0 - first) * (child + rng_.in(0.1, 0.9)) / kChildren[level];
            // Children stand around the branch at equal angles, steeper toward its end.
            const double around = 2.0 * kPi * (child * 0.382 + rng_.in(0.0, 0.1)), lean = kAngle[level] * (1.25 - 0.5 * share);
            const Vec3 across = side * std::cos(around) + front * std::sin(around);
            const Vec3 direction = normalized(branch.direction * std::cos(lean) + across * std::sin(lean) + kUp * 0.1);
            uint16_t joint = branch.joint;
            if (level == 0) {
                joint = static_cast<uint16_t>(joints_.size());
                joints_.push_back(at(share));
            }
            const double length = branch.length * kShrink[level] * rng_.in(0.8, 1.1);
            grow({at(share), direction, length, 0.5 * branch.radius * (1.15 - 0.5 * share), level + 1, joint});
        }
    }

    Rng rng_;
    Mesh branches_;
    std::vector<Twig> twigs_;
    std::vector<Vec3> joints_;  ///< Where the limbs begin; 0 is the trunk's.
};

/// The limbs turn to and fro about where they begin, each at its own time, all within a second.
std::vector<int> add_swaying_joints(GltfWriter& writer, const std::vector<Vec3>& joints, double sway) {
    const int times = writer.add_times(key_times(1.0, 48));
    std::vector<int> nodes = {writer.add_node("trunk")};
    for (std::size_t j = 1; j < joints.size(); ++j) {
        std::vector<Quat> rotations;
        for (const double s : key_times(1.0, 48)) {
            const double phase = 2.0 * kPi * (2.0 * s + 0.618 * static_cast<double>(j));
            rotations.push_back(axis_angle({0, 0, 1}, sway * std::sin(phase)) * axis_angle({1, 0, 0}, sway * std::cos(phase)));
        }
        nodes.push_back(writer.add_node("limb " + std::to_string(j), {joints[j], rotations[0]}, nodes[0]));
        writer.animate_rotation(nodes.back(), times, rotations);
    }
    return nodes;
}

}  // namespace

void make_tree(const std::filesystem::path& path, const TreeOptions& options) {
    require_range("leaves", options.leaves, 100, 1e6);
    require_range("sway", options.sway, 0.0, 0.5);
    GltfWriter writer("tree");
    add_ground(writer, 40.0, 0.0, from_srgb(190, 196, 150));
    Tree tree(options.seed);
    // All leaves together have the same area at any number of them.
    Mesh leaves = tree.leaves(options.leaves, 0.17 * std::sqrt(12000.0 / options.leaves)), branches = tree.branches();
    std::vector<int> nodes;
    if (options.sway > 0.0) nodes = add_swaying_joints(writer, tree.joints(), options.sway);
    const auto add = [&](const std::string& name, Mesh& mesh) {
        const bool still = nodes.empty();
        if (still) {
            mesh.joints.clear();
            mesh.weights.clear();
        }
        const Primitive primitive{&mesh, writer.add_material(name, {})};
        const int index = writer.add_mesh(name, {&primitive, 1});
        still ? writer.add_mesh_node(name, index) : writer.add_skinned_node(name, index, nodes, tree.joints());
    };
    add("branches", branches);
    add("leaves", leaves);

    // The light flies to and fro past the tree, 0.9 m in the first shutter, and does not turn.
    constexpr double kReach = 3.48, kSwings = 2.0;
    const Vec3 middle{4.6, 11.0, 5.3}, along = normalized({-5.3, 0.0, 4.6});
    const Placement aimed = looking_at(middle, {0.0, 2.4, 0.0});
    const std::vector<double> seconds = key_times(1.0, 96);
    std::vector<Vec3> positions;
    for (const double s : seconds) positions.push_back(middle + along * (kReach * std::sin(2.0 * kPi * kSwings * s)));
    const int light = writer.add_spot_light("light", aimed, {1.0, 0.94, 0.82}, 760.0, 0.4, 0.8);
    writer.animate_translation(light, writer.add_times(seconds), positions);
    if (options.fill_light) add_fill_light(writer, {0.3, -0.7, -0.8});
    writer.add_camera("camera", {2.2, 8.0, 13.0}, {-0.6, 2.95, 0.0}, 0.56, 16.0 / 9.0, 0.1, 200.0);
    writer.write(path);
}

}  // namespace gnomon::makers
