// SPDX-License-Identifier: Apache-2.0
// Scenes for tests, benchmarks and pictures, written as glTF 2.0 with a camera, lights and one animation that starts at 0 s.
// The same options give the same bytes. Units are metres, seconds and radians; "shutter" is 0 s to kShutterSeconds.
#pragma once

#include <cstdint>
#include <filesystem>

namespace gnomon::makers {

/// The shutter that gnomon renders by default.
inline constexpr double kShutterSeconds = 1.0 / 48.0;

/// A skinned figure walks through a studio with a spinning pinwheel and a bouncing ball. Light 0 is the key light
/// (directional), light 1 a weak fill light. The walk is one cycle of one second, and its lowest vertex is always on the
/// ground, y = 0.
struct FigureOptions {
    uint32_t triangles = 12000;  ///< Of the whole scene, within 10 %; 2,000 to 1,000,000.
    bool fill_light = true;
};
void make_figure(const std::filesystem::path& path, const FigureOptions& options = {});

/// A skinned figure that kicks: its leg swings toward a spot light before it.
struct CharacterOptions {
    uint32_t triangles = 70000;  ///< Of the figure, within 3 %; 2,000 to 2,000,000.
    bool fill_light = false;
};
void make_character(const std::filesystem::path& path, const CharacterOptions& options = {});

/// A skinned figure runs through a hall of two arcades, open to the sky.
struct RunnerOptions {
    uint32_t triangles = 262000;  ///< Of the whole scene, within 10 %; 20,000 to 2,000,000.
    bool fill_light = false;
};
void make_runner(const std::filesystem::path& path, const RunnerOptions& options = {});

/// A wrecking ball on a chain swings at a jointed wooden doll.
struct WreckingBallOptions {
    uint32_t triangles = 8000;  ///< Of the whole scene, within 10 %; 4,000 to 1,000,000.
    bool fill_light = false;
};
void make_wrecking_ball(const std::filesystem::path& path, const WreckingBallOptions& options = {});

/// A tree of branches and leaf cards under a spot light that flies past it.
struct TreeOptions {
    uint32_t leaves = 12000;  ///< Two triangles each; 100 to 1,000,000.
    uint32_t seed = 0;
    double sway = 0.0;  ///< How far the limbs turn to and fro, radians; 0 to 0.5. Without it only the light moves.
    bool fill_light = false;
};
void make_tree(const std::filesystem::path& path, const TreeOptions& options = {});

/// An octopus over a plane, its skinned arms with their suction cups moving in different directions. Camera 1 looks from
/// above at their shadows.
struct OctopusOptions {
    uint32_t triangles = 200000;  ///< Of the octopus, within 10 %; 50,000 to 4,000,000.
    uint32_t seed = 0;
    bool fill_light = false;
};
void make_octopus(const std::filesystem::path& path, const OctopusOptions& options = {});

/// A game of chess with lathed pieces, some of which fly up from the board and tumble.
inline constexpr uint32_t kChessPieces = 32;
struct ChessOptions {
    uint32_t triangles = 160000;  ///< Of all pieces, within 10 %; 10,000 to 4,000,000.
    uint32_t moving = 9;          ///< Pieces, 1 to kChessPieces.
    uint32_t seed = 0;
    bool fill_light = false;
};
void make_chess(const std::filesystem::path& path, const ChessOptions& options = {});

/// Two instances of a tessellated unit cube fly toward a directional light above them, four fifths of their side in a shutter.
struct TwoCubesOptions {
    uint32_t triangles = 6000;  ///< Of each cube, to the nearest 12 n^2; 12 to 1,000,000.
    double ground = 28.0;       ///< Side, 1 to 1,000 metres. The light's view holds it all.
};
void make_two_cubes(const std::filesystem::path& path, const TwoCubesOptions& options = {});

/// Cubes that move and turn in random directions, all in one skinned mesh with a joint per cube.
struct RandomCubesOptions {
    uint32_t count = 2000;  ///< 1 to 65,535.
    uint32_t seed = 0;
    double size = 1.0;       ///< Side, > 0.
    double speed_min = 4.0;  ///< Metres in a shutter, 0 <= speed_min <= speed_max.
    double speed_max = 8.0;
    /// Metres, of the space that they fill and the picture shows, 0 to 10,000; 0: it grows with their number, size and speed,
    /// so that they cover about the same share of the picture.
    double height = 0.0;
    double ground = 4.0;  ///< Side, in heights of that space, 0.1 to 100. The light's view holds it all.
    double times = 1.0;   ///< The speeds that they really have, over those from which the space follows; 0 to 100.
};
void make_random_cubes(const std::filesystem::path& path, const RandomCubesOptions& options = {});

/// A grid of pillars below a spot light that circles over them as it climbs, or flies up and away from them (Andersson et al.
/// 2015, Fig. 11).
struct PillarsOptions {
    uint32_t columns = 7;  ///< Along x and z, 1 to 100.
    bool rising = false;   ///< The light flies up and away.
};
void make_pillars(const std::filesystem::path& path, const PillarsOptions& options = {});

/// A skinned tube that fills most of the picture, rises and bends.
struct TubeOptions {
    uint32_t triangles = 70000;  ///< Of the tube, within 5 %; 1,000 to 2,000,000.
    double pixels = 10.0;        ///< How far it moves in a shutter, on average, in a picture of 1024x768; 0 to 200.
    double ground = 8.0;         ///< Side, 1 to 1,000 metres. The light's view holds it all.
};
void make_tube(const std::filesystem::path& path, const TubeOptions& options = {});

/// A finely tessellated vase, 1 m high, slides over a ground of 200 m. The light's view holds it all: of 1024 texels the vase
/// takes 5.
struct StadiumOptions {
    uint32_t triangles = 30000;  ///< Of the vase, within 5 %; 1,000 to 4,000,000.
    double motion = 0.3;         ///< Metres in a shutter, 0 to 10.
};
void make_stadium(const std::filesystem::path& path, const StadiumOptions& options = {});

/// Two level quads over a plane, at two heights, that fly past each other at right angles: three times their side in a shutter.
void make_crossing_quads(const std::filesystem::path& path);

/// Two level quads below a spot light, one rising toward it and one sinking, by more than their height over the plane.
void make_receding_quads(const std::filesystem::path& path);

/// The small instances that the scenes folder holds, as figure.gltf, two-cubes.gltf and so on.
void make_all(const std::filesystem::path& folder);

/// Errors of all makers: ErrorKind::usage for an option out of its range or a name that does not end in .gltf or .glb,
/// ErrorKind::input if a file cannot be written.

}  // namespace gnomon::makers
