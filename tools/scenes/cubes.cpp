// SPDX-License-Identifier: Apache-2.0
// Scenes of moving cubes: two-cubes and random-cubes.
#include "common.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {

void make_two_cubes(const std::filesystem::path& path, const TwoCubesOptions& options) {
    require_range("triangles", options.triangles, 12, 1e6);
    require_range("ground", options.ground, 1.0, 1e3);
    GltfWriter writer("two-cubes");
    add_ground(writer, 0.5 * options.ground, 0.0, from_srgb(205, 198, 184));

    const Vec3 to_light = normalized({-0.35, 1.0, 0.25});
    const Mesh cube = box({0.5, 0.5, 0.5}, box_divisions(options.triangles));
    const std::vector<double> seconds = key_times(2.0 * kShutterSeconds, 1);
    const int times = writer.add_times(seconds);
    const auto add_cube = [&](const std::string& name, Rgb color, Vec3 start) {
        const Primitive primitive{&cube, writer.add_material(name, color)};
        const int node = writer.add_mesh_node(name, writer.add_mesh(name, {&primitive, 1}), {start, {}});
        const Vec3 keys[] = {start, start + to_light * 1.6};
        writer.animate_translation(node, times, keys);
    };
    add_cube("low cube", from_srgb(214, 90, 70), {0.55, 0.7, 0.1});
    add_cube("high cube", from_srgb(72, 132, 190), {-0.55, 1.9, 0.5});

    writer.add_camera("camera", {1.4, 4.5, 5.4}, {0.05, 1.15, 0.0}, 0.65, 16.0 / 9.0, 0.1, 100.0);
    writer.add_directional_light("light", to_light * -1.0, to_light * 8.0, {1.0, 0.97, 0.92}, 3.2);
    writer.write(path);
}

void make_random_cubes(const std::filesystem::path& path, const RandomCubesOptions& options) {
    require_range("count", options.count, 1, 65535);
    require_range("size", options.size, 1e-3, 1e3);
    require_range("speed_max", options.speed_max, 0.0, 1e4);
    require_range("speed_min", options.speed_min, 0.0, options.speed_max);
    require_range("height", options.height, 0.0, 1e4);
    require_range("ground", options.ground, 0.1, 100.0);
    require_range("times", options.times, 0.0, 100.0);

    // A cube's mean silhouette is 1.5 size^2 and its mean width about 1.3 size; of its path pi / 4 is seen on average. Cubes
    // with three times the picture's area together cover about 1 - exp(-3) of it where they lie at random, less toward its
    // edges.
    const double mean_speed = (options.speed_min + options.speed_max) / 2.0;
    const double swept = options.size * (1.5 * options.size + 1.3 * kPi / 4.0 * mean_speed);
    const double height = options.height > 0.0 ? options.height : std::sqrt(options.count * swept / 3.0 * 3.0 / 4.0);
    const Vec3 half{height * 2.0 / 3.0, height / 2.0, height / 2.0};

    GltfWriter writer("random-cubes");
    add_ground(writer, 0.5 * options.ground * height, -0.62 * height, from_srgb(190, 186, 178));
    static const Rgb kPalette[] = {from_srgb(224, 108, 80), from_srgb(240, 190, 90), from_srgb(86, 148, 176),
                                   from_srgb(120, 170, 120), from_srgb(236, 228, 212)};

    Rng rng(options.seed);
    const std::vector<double> seconds = key_times(2.0 * kShutterSeconds, 2);
    const int times = writer.add_times(seconds);
    const Mesh unit = box({options.size / 2.0, options.size / 2.0, options.size / 2.0}, 1);
    Mesh cubes;
    const int root = writer.add_node("all cubes");  // The joints of a skin need a common ancestor.
    std::vector<int> joints;
    for (uint32_t i = 0; i < options.count; ++i) {
        // The middle of the first shutter is where the cube is placed.
        const Vec3 center{rng.in(-half.x, half.x), rng.in(-half.y, half.y), rng.in(-half.z, half.z)};
        const Vec3 velocity = rng.direction() * (options.times * rng.in(options.speed_min, options.speed_max));
        const Vec3 axis = rng.direction();
        const double start_angle = rng.in(0.0, 2.0 * kPi), turn = rng.in(0.2, 1.2);

        Mesh cube = unit;
        cube.paint(bytes_of(kPalette[i % std::size(kPalette)]));
        cube.bind(static_cast<uint16_t>(i));
        cubes.append(cube);

        Vec3 translations[3];
        Quat rotations[3];
        for (int key = 0; key < 3; ++key) {
            translations[key] = center + velocity * (key - 0.5);
            rotations[key] = axis_angle(axis, start_angle + turn * key);
        }
        const int joint = writer.add_node("cube " + std::to_string(i), {translations[0], rotations[0]}, root);
        writer.animate_translation(joint, times, translations);
        writer.animate_rotation(joint, times, rotations);
        joints.push_back(joint);
    }
    const Primitive primitive{&cubes, writer.add_material("cubes", {})};
    writer.add_skinned_node("cubes", writer.add_mesh("cubes", {&primitive, 1}), joints,
                            std::vector<Vec3>(options.count));  // Each cube is modelled about its joint.

    const double yfov = 0.6;
    const double distance = half.z + half.y / std::tan(yfov / 2.0);
    const Vec3 to_light = normalized({-0.45, 1.0, 0.5});
    writer.add_camera("camera", {0.0, 0.0, distance}, {}, yfov, 4.0 / 3.0, 0.01 * height, 8.0 * height);
    writer.add_directional_light("light", to_light * -1.0, to_light * height, {1.0, 0.97, 0.92}, 3.4);
    writer.write(path);
}

}  // namespace gnomon::makers
