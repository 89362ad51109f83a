// SPDX-License-Identifier: Apache-2.0
// The scene chess: a game whose pieces fly off, after that of Andersson et al. 2015 (Fig. 14).
#include <algorithm>
#include <map>

#include "common.hpp"
#include "scene_makers.hpp"

namespace gnomon::makers {
namespace {

/// White from below, files from the left, as in a FEN record; a field is one metre wide.
constexpr const char* kRows[] = {"r.bq.rk.", "pp..bppp", "..n.pn..", "..pp....",
                                 "...P.B..", "..PBPN..", "PP.N.PPP", "R..QK..R"};

using Profile = std::vector<ProfilePoint>;

/// The foot that all pieces share, and what stands on it.
Profile on_foot(double width, const Profile& rest) {
    Profile profile = {{0.36, 0.0}, {0.38, 0.02}, {0.38, 0.08}, {0.33, 0.12}, {0.34, 0.16}, {0.31, 0.2}, {0.23, 0.26}};
    for (ProfilePoint& point : profile) point.radius *= width;
    profile.insert(profile.end(), rest.begin(), rest.end());
    return profile;
}

/// The points of a ball on a neck, up to `end` radians from its lowest point.
Profile ball(double radius, double center, double first, double end) {
    constexpr int kSteps = 12;
    Profile profile;
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = first + (end - first) * i / kSteps;
        profile.push_back({radius * std::sin(angle), center - radius * std::cos(angle)});
    }
    return profile;
}

Profile joined(Profile a, const Profile& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

Profile profile_of(char piece) {
    switch (piece) {
        case 'p':
            return on_foot(0.78, joined({{0.13, 0.36}, {0.1, 0.55}, {0.18, 0.6}, {0.18, 0.63}}, ball(0.16, 0.78, 0.5, 3.0)));
        case 'r':
            return on_foot(0.95,
                           {{0.21, 0.4}, {0.18, 0.78}, {0.26, 0.84}, {0.27, 1.08}, {0.2, 1.08}, {0.19, 1.0}, {0.02, 1.0}});
        case 'n':
            return on_foot(0.95, {{0.22, 0.3}, {0.2, 0.36}, {0.02, 0.38}});
        case 'b':
            return on_foot(0.9, {{0.15, 0.4},
                                 {0.11, 0.8},
                                 {0.2, 0.86},
                                 {0.2, 0.89},
                                 {0.1, 0.94},
                                 {0.16, 1.04},
                                 {0.17, 1.12},
                                 {0.13, 1.25},
                                 {0.04, 1.37},
                                 {0.06, 1.41},
                                 {0.05, 1.45},
                                 {0.01, 1.47}});
        case 'q':
            return on_foot(1.0, {{0.17, 0.42},
                                 {0.12, 1.0},
                                 {0.23, 1.07},
                                 {0.23, 1.1},
                                 {0.12, 1.15},
                                 {0.15, 1.3},
                                 {0.25, 1.52},
                                 {0.21, 1.54},
                                 {0.15, 1.49},
                                 {0.05, 1.54},
                                 {0.07, 1.6},
                                 {0.05, 1.65},
                                 {0.01, 1.67}});
        default:
            return on_foot(1.0, {{0.18, 0.42},
                                 {0.13, 1.1},
                                 {0.24, 1.17},
                                 {0.24, 1.2},
                                 {0.13, 1.25},
                                 {0.16, 1.45},
                                 {0.23, 1.64},
                                 {0.2, 1.7},
                                 {0.05, 1.76},
                                 {0.01, 1.77}});
    }
}

/// A knight's neck and head, looking along +X.
Mesh horse(uint32_t triangles) {
    struct Section {
        Vec3 center;
        double along, across;  ///< Half sizes in the plane of symmetry and out of it.
        double turn;           ///< Of the section from level, radians.
    };
    static constexpr Section kSections[] = {
        {{-0.02, 0.36, 0}, 0.2, 0.17, 0.0},   {{-0.07, 0.58, 0}, 0.2, 0.13, 0.1},    {{-0.09, 0.8, 0}, 0.19, 0.115, -0.1},
        {{-0.05, 0.99, 0}, 0.18, 0.11, -0.5}, {{0.03, 1.09, 0}, 0.17, 0.105, -1.1},  {{0.13, 1.06, 0}, 0.15, 0.1, -1.7},
        {{0.24, 0.97, 0}, 0.115, 0.09, -2.0}, {{0.34, 0.88, 0}, 0.095, 0.08, -2.15}, {{0.4, 0.82, 0}, 0.07, 0.06, -2.2}};
    constexpr std::size_t kCount = std::size(kSections);
    const Cut cut = cut_for(triangles, 1.2);
    std::vector<Ring> rings;
    for (uint32_t r = 0; r < cut.rings; ++r) {
        const double at = static_cast<double>(r) / (cut.rings - 1) * (kCount - 1);
        const std::size_t i = std::min(static_cast<std::size_t>(at), kCount - 2);
        const double t = at - static_cast<double>(i);
        const Section &a = kSections[i], &b = kSections[i + 1];
        const auto mix = [&](double from, double to) { return from + (to - from) * t; };
        const double turn = mix(a.turn, b.turn), along = mix(a.along, b.along), across = mix(a.across, b.across);
        rings.push_back(
            {a.center + (b.center - a.center) * t, {0.0, 0.0, across}, {along * std::cos(turn), along * std::sin(turn), 0.0}});
    }
    return tube(kSections[0].center, rings, kSections[kCount - 1].center, cut.sides);
}

Mesh piece_mesh(char piece, uint32_t triangles) {
    if (piece == 'n') {
        Mesh mesh = lathe(profile_of(piece), triangles / 2);
        mesh.append(horse(triangles / 2));
        return mesh;
    }
    Mesh mesh = lathe(profile_of(piece), triangles);
    if (piece == 'k') {
        for (const Vec3 half_size : {Vec3{0.03, 0.14, 0.03}, Vec3{0.1, 0.03, 0.032}}) {
            Mesh bar = box(half_size, 1);
            bar.uvs.clear();
            bar.map([](Vec3 p) { return p + Vec3{0.0, 1.9, 0.0}; });
            mesh.append(bar);
        }
    }
    return mesh;
}

Mesh board() {
    Mesh mesh = box({4.6, 0.15, 4.6}, 1);
    mesh.map([](Vec3 p) { return p + Vec3{0.0, -0.192, 0.0}; });
    mesh.paint(bytes_of(from_srgb(92, 56, 40)));
    for (int row = 0; row < 8; ++row) {
        for (int file = 0; file < 8; ++file) {
            Mesh field = box({0.496, 0.02, 0.496}, 1);
            field.map([&](Vec3 p) { return p + Vec3{file - 3.5, -0.02, row - 3.5}; });
            field.paint(bytes_of((row + file) % 2 == 0 ? from_srgb(226, 204, 164) : from_srgb(140, 90, 60)));
            mesh.append(field);
        }
    }
    return mesh;
}

/// A piece is thrown up from its field: it flies and tumbles evenly, a quarter to six tenths of a field in a shutter.
void throw_piece(GltfWriter& writer, int node, int times, Vec3 start, Quat facing, Rng& rng) {
    const double heading = rng.in(0.0, 2.0 * kPi), across = rng.in(0.1, 0.35), up = rng.in(0.25, 0.5), turn = rng.in(0.15, 0.5);
    const Vec3 velocity{across * std::cos(heading), up, across * std::sin(heading)};
    const Vec3 axis{std::sin(heading), 0.0, -std::cos(heading)};
    const double already = rng.in(0.1, 1.0);  // Shutters since it left the board.
    std::vector<Vec3> translations;
    std::vector<Quat> rotations;
    for (int key = 0; key <= 2; ++key) {
        translations.push_back(start + velocity * (already + key));
        rotations.push_back(axis_angle(axis, -turn * (already + key)) * facing);
    }
    writer.animate_translation(node, times, translations);
    writer.animate_rotation(node, times, rotations);
}

}  // namespace

void make_chess(const std::filesystem::path& path, const ChessOptions& options) {
    require_range("triangles", options.triangles, 10000, 4e6);
    require_range("moving", options.moving, 1, kChessPieces);
    GltfWriter writer("chess");
    add_ground(writer, 20.0, -0.4, from_srgb(196, 190, 180));
    const Mesh fields = board();
    const Primitive wood{&fields, writer.add_material("board", {})};
    writer.add_mesh_node("board", writer.add_mesh("board", {&wood, 1}));
    const int white = writer.add_material("white", from_srgb(240, 228, 202));
    const int black = writer.add_material("black", from_srgb(74, 66, 72));

    // `moving` of the pieces, each set of them as likely as any other.
    Rng rng(options.seed);
    std::vector<bool> moves(kChessPieces);
    for (uint32_t left = kChessPieces, wanted = options.moving; left > 0; --left) {
        moves[kChessPieces - left] = rng.unit() * left < wanted;
        wanted -= moves[kChessPieces - left] ? 1 : 0;
    }
    const int times = writer.add_times(key_times(2.0 * kShutterSeconds, 2));
    std::map<char, int> meshes;  // By letter, so that equal pieces share one.
    uint32_t number = 0;
    for (int row = 0; row < 8; ++row) {
        for (int file = 0; file < 8; ++file) {
            const char letter = kRows[row][file];
            if (letter == '.') continue;
            const bool is_black = letter >= 'a';
            const std::string name = std::string(is_black ? "black " : "white ") + letter;
            if (!meshes.contains(letter)) {
                const char piece = is_black ? letter : static_cast<char>(letter - 'A' + 'a');
                const Mesh mesh = piece_mesh(piece, options.triangles / kChessPieces);
                const Primitive primitive{&mesh, is_black ? black : white};
                meshes[letter] = writer.add_mesh(name, {&primitive, 1});
            }
            // A hair above the board.
            const Placement placement{{file - 3.5, 1e-3, row - 3.5}, axis_angle({0, 1, 0}, is_black ? -kPi / 2.0 : kPi / 2.0)};
            const int node = writer.add_mesh_node(name + std::to_string(number), meshes[letter], placement);
            if (moves[number++]) throw_piece(writer, node, times, placement.translation, placement.rotation, rng);
        }
    }
    writer.add_camera("camera", {3.4, 7.0, 10.0}, {0.0, 0.35, 0.35}, 0.58, 16.0 / 9.0, 0.1, 100.0);
    writer.add_spot_light("light", looking_at({-6.0, 9.0, 3.0}, {}), {1.0, 0.96, 0.9}, 620.0, 0.6, 0.8);
    if (options.fill_light) add_fill_light(writer, {-0.5, -0.8, -0.6});
    writer.write(path);
}

}  // namespace gnomon::makers
