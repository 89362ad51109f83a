// SPDX-License-Identifier: Apache-2.0
// make_scenes: the scene makers as a command.
#include <CLI/CLI.hpp>
#include <functional>
#include <gnomon/error.hpp>
#include <gnomon/version.hpp>
#include <memory>
#include <string>
#include <utility>

#include "scene_makers.hpp"
#include "tool_main.hpp"

namespace {

using namespace gnomon;
using namespace gnomon::makers;
using Path = std::filesystem::path;

struct Options {
    Path output;
    std::function<void()> make;  ///< The scene that is named.
};

CLI::App* add_command(CLI::App& app, Options& options, const char* name, const char* description,
                      std::function<void(const Path&)> make) {
    CLI::App* command = app.add_subcommand(name, description);
    command->add_option("-o,--output", options.output, "FILE.gltf, with a .bin beside it, or FILE.glb; of 'all' a folder")
        ->required()
        ->type_name("FILE");
    command->callback([&options, make = std::move(make)] { options.make = [&options, make] { make(options.output); }; });
    return command;
}

/// The command of a scene. Its options are members of `Values`, and say what they are there.
template <class Values>
class Scene {
public:
    Scene(CLI::App& app, Options& options, const char* name, const char* description, void (*make)(const Path&, const Values&))
        : command_(add_command(app, options, name, description,
                               [values = values_, make](const Path& path) { make(path, *values); })) {}

    template <class Number>
    Scene& add(const char* option, Number Values::*value, const char* type, const char* description) {
        command_->add_option(option, (*values_).*value, description)->type_name(type)->capture_default_str();
        return *this;
    }
    Scene& add(const char* option, bool Values::*value, const char* description) {
        command_->add_option(option, (*values_).*value, description)
            ->type_name("yes|no")
            ->check(CLI::IsMember({"yes", "no"}).description(""))
            ->default_str((*values_).*value ? "yes" : "no");
        return *this;
    }
    Scene& add_speed() {
        command_
            ->add_option_function<std::vector<double>>(
                "--speed",
                [values = values_](const std::vector<double>& range) {
                    values->speed_min = range[0];
                    values->speed_max = range[1];
                },
                "Metres in a shutter")
            ->delimiter(':')
            ->expected(2)
            ->type_name("MIN:MAX")
            ->default_str("4:8");
        return *this;
    }

    Scene& add_triangles(const char* of) { return add("--triangles", &Values::triangles, "N", of); }
    Scene& add_seed() { return add("--seed", &Values::seed, "S", "Same seed, same bytes"); }
    Scene& add_ground() { return add("--ground", &Values::ground, "METRES", "Side of the ground"); }
    Scene& add_fill_light() { return add("--fill-light", &Values::fill_light, "A second, weak light"); }

private:
    std::shared_ptr<Values> values_ = std::make_shared<Values>();
    CLI::App* command_;
};

void add_options(CLI::App& app, Options& o) {
    app.set_version_flag("--version", "gnomon " GNOMON_VERSION);
    app.set_help_flag();
    app.set_help_all_flag("-h,--help", "Print this help");  // That of all scenes.
    app.require_subcommand(0, 1);                           // None is an error below: CLI11 would not name an unknown one.

    add_command(app, o, "all", "The scenes of the scenes folder", make_all);
    Scene(app, o, "figure", "A figure that walks through a studio", make_figure)
        .add_triangles("Of the whole scene")
        .add_fill_light();
    Scene(app, o, "character", "A figure that kicks", make_character).add_triangles("Of the figure").add_fill_light();
    Scene(app, o, "runner", "A figure that runs through a hall", make_runner)
        .add_triangles("Of the whole scene")
        .add_fill_light();
    Scene(app, o, "wrecking-ball", "A ball on a chain and a wooden doll", make_wrecking_ball)
        .add_triangles("Of the whole scene")
        .add_fill_light();
    Scene(app, o, "tree", "A tree under a light that flies past it", make_tree)
        .add("--leaves", &TreeOptions::leaves, "N", "Of two triangles each")
        .add_seed()
        .add("--sway", &TreeOptions::sway, "RADIANS", "How far the limbs turn to and fro")
        .add_fill_light();
    Scene(app, o, "octopus", "An octopus that moves its arms", make_octopus)
        .add_triangles("Of the octopus")
        .add_seed()
        .add_fill_light();
    Scene(app, o, "chess", "Chess pieces, some of which fly up", make_chess)
        .add_triangles("Of all pieces")
        .add("--moving", &ChessOptions::moving, "PIECES", "How many fly up")
        .add_seed()
        .add_fill_light();
    Scene(app, o, "two-cubes", "Two cubes that fly toward the light", make_two_cubes)
        .add_triangles("Of each cube")
        .add_ground();
    Scene(app, o, "random-cubes", "Cubes that move and turn in random directions", make_random_cubes)
        .add("--count", &RandomCubesOptions::count, "N", "Of cubes")
        .add_seed()
        .add("--size", &RandomCubesOptions::size, "METRES", "Side of a cube")
        .add_speed()
        .add("--height", &RandomCubesOptions::height, "METRES", "Of their space; 0: by number, size and speed")
        .add("--ground", &RandomCubesOptions::ground, "HEIGHTS", "Side of the ground, in heights of their space")
        .add("--times", &RandomCubesOptions::times, "FACTOR", "On the speed, in the same space");
    Scene(app, o, "pillars", "Pillars below a spot light that moves", make_pillars)
        .add("--columns", &PillarsOptions::columns, "N", "Along each side")
        .add("--rising", &PillarsOptions::rising, "The light flies up and away");
    add_command(app, o, "crossing-quads", "Two quads that fly past each other", make_crossing_quads);
    add_command(app, o, "receding-quads", "Two quads that rise and sink", make_receding_quads);
    Scene(app, o, "tube", "A tube that rises and bends", make_tube)
        .add_triangles("Of the tube")
        .add("--pixels", &TubeOptions::pixels, "P", "Its motion in a picture of 1024x768, on average")
        .add_ground();
    Scene(app, o, "stadium", "A small vase on a wide ground", make_stadium)
        .add_triangles("Of the vase")
        .add("--motion", &StadiumOptions::motion, "METRES", "In a shutter");
}

void run(const Options& options) {
    if (!options.make) throw Error(ErrorKind::usage, "no scene given", "command line", "see 'make_scenes --help'");
    options.make();
}

}  // namespace

int main(int argc, char** argv) {
    constexpr tools::Tool kTool{"make_scenes", "Writes one scene as .gltf (with a .bin beside it) or .glb.",
                                "make a smaller scene"};
    return tools::tool_main(kTool, argc, argv, add_options, run);
}
