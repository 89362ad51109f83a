// SPDX-License-Identifier: Apache-2.0
// make_scenes: the scene makers as a command.
#include <charconv>
#include <cstdio>
#include <exception>
#include <functional>
#include <gnomon/error.hpp>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene_makers.hpp"

namespace {

using gnomon::Error;
using gnomon::ErrorKind;
namespace makers = gnomon::makers;

constexpr const char* kHelp =
    R"(make_scenes SCENE -o FILE [options]    writes one scene as .gltf (with a .bin beside it) or .glb
make_scenes all -o FOLDER              writes the scenes of the scenes folder

  figure         --triangles N (12000)  --fill-light yes|no (yes)
  character      --triangles N of the figure (70000)  --fill-light yes|no (no)
  runner         --triangles N (262000)  --fill-light yes|no (no)
  wrecking-ball  --triangles N (8000)  --fill-light yes|no (no)
  tree           --leaves N (12000)  --seed S (0)  --sway RADIANS (0)  --fill-light yes|no (no)
  octopus        --triangles N (200000)  --seed S (0)  --fill-light yes|no (no)
  chess          --triangles N (160000)  --moving PIECES (9)  --seed S (0)  --fill-light yes|no (no)
  two-cubes      --triangles N of each cube (6000)  --ground METRES (28)
  random-cubes   --count N (2000)  --seed S (0)  --size METRES (1)  --speed MIN:MAX metres per shutter (4:8)
                 --height METRES of their space (0: by number, size and speed)  --ground HEIGHTS (4)  --times FACTOR on the speed, in the same space (1)
  pillars        --columns N (7)  --rising yes|no (no)
  crossing-quads
  receding-quads
  tube           --triangles N (70000)  --pixels P (10)  --ground METRES (8)
  stadium        --triangles N of the body (30000)  --motion METRES per shutter (0.3)
)";

template <class T>
T number(const std::string& option, std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
        throw Error(ErrorKind::usage, "not a number: '" + std::string(text) + "'", option, "see make_scenes --help");
    }
    return value;
}

/// The options after the scene's name; each may be taken once, and all must be.
class Options {
public:
    Options(int count, char** arguments) {
        for (int i = 2; i < count; ++i) {
            std::string name = arguments[i], value;
            const std::size_t equals = name.find('=');
            if (name.rfind("--", 0) == 0 && equals != std::string::npos) {
                value = name.substr(equals + 1);
                name.resize(equals);
            } else if (++i < count) {
                value = arguments[i];
            } else {
                throw Error(ErrorKind::usage, "value missing", name, "see make_scenes --help");
            }
            values_[name] = value;
        }
    }

    template <class T>
    void take(const std::string& name, T& into) {
        if (const auto text = take_text(name); !text.empty()) into = number<T>(name, text);
    }
    std::string take_text(const std::string& name) {
        const auto node = values_.extract(name);
        return node ? node.mapped() : std::string{};
    }
    void take_yes(const std::string& name, bool& into) {
        const std::string text = take_text(name);
        if (text.empty()) return;
        if (text != "yes" && text != "no") throw Error(ErrorKind::usage, "not yes or no: '" + text + "'", name, "");
        into = text == "yes";
    }
    void require_empty() const {
        if (values_.empty()) return;
        throw Error(ErrorKind::usage, "unknown option for this scene", values_.begin()->first, "see make_scenes --help");
    }

private:
    std::map<std::string, std::string> values_;
};

void run(const std::string& scene, Options options) {
    const std::string output = options.take_text("-o");
    if (output.empty())
        throw Error(ErrorKind::usage, "no output named", "-o", "give a .gltf or .glb file, or a folder for 'all'");
    std::function<void()> make;
    if (scene == "figure") {
        makers::FigureOptions o;
        options.take("--triangles", o.triangles);
        options.take_yes("--fill-light", o.fill_light);
        make = [=] { makers::make_figure(output, o); };
    } else if (scene == "character") {
        makers::CharacterOptions o;
        options.take("--triangles", o.triangles);
        options.take_yes("--fill-light", o.fill_light);
        make = [=] { makers::make_character(output, o); };
    } else if (scene == "runner") {
        makers::RunnerOptions o;
        options.take("--triangles", o.triangles);
        options.take_yes("--fill-light", o.fill_light);
        make = [=] { makers::make_runner(output, o); };
    } else if (scene == "wrecking-ball") {
        makers::WreckingBallOptions o;
        options.take("--triangles", o.triangles);
        options.take_yes("--fill-light", o.fill_light);
        make = [=] { makers::make_wrecking_ball(output, o); };
    } else if (scene == "tree") {
        makers::TreeOptions o;
        options.take("--leaves", o.leaves);
        options.take("--seed", o.seed);
        options.take("--sway", o.sway);
        options.take_yes("--fill-light", o.fill_light);
        make = [=] { makers::make_tree(output, o); };
    } else if (scene == "octopus") {
        makers::OctopusOptions o;
        options.take("--triangles", o.triangles);
        options.take("--seed", o.seed);
        options.take_yes("--fill-light", o.fill_light);
        make = [=] { makers::make_octopus(output, o); };
    } else if (scene == "chess") {
        makers::ChessOptions o;
        options.take("--triangles", o.triangles);
        options.take("--moving", o.moving);
        options.take("--seed", o.seed);
        options.take_yes("--fill-light", o.fill_light);
        make = [=] { makers::make_chess(output, o); };
    } else if (scene == "two-cubes") {
        makers::TwoCubesOptions o;
        options.take("--triangles", o.triangles);
        options.take("--ground", o.ground);
        make = [=] { makers::make_two_cubes(output, o); };
    } else if (scene == "random-cubes") {
        makers::RandomCubesOptions o;
        options.take("--count", o.count);
        options.take("--seed", o.seed);
        options.take("--size", o.size);
        options.take("--height", o.height);
        options.take("--ground", o.ground);
        options.take("--times", o.times);
        if (const std::string speed = options.take_text("--speed"); !speed.empty()) {
            const std::size_t colon = speed.find(':');
            if (colon == std::string::npos) throw Error(ErrorKind::usage, "not MIN:MAX: '" + speed + "'", "--speed", "");
            o.speed_min = number<double>("--speed", std::string_view(speed).substr(0, colon));
            o.speed_max = number<double>("--speed", std::string_view(speed).substr(colon + 1));
        }
        make = [=] { makers::make_random_cubes(output, o); };
    } else if (scene == "pillars") {
        makers::PillarsOptions o;
        options.take("--columns", o.columns);
        options.take_yes("--rising", o.rising);
        make = [=] { makers::make_pillars(output, o); };
    } else if (scene == "crossing-quads") {
        make = [=] { makers::make_crossing_quads(output); };
    } else if (scene == "receding-quads") {
        make = [=] { makers::make_receding_quads(output); };
    } else if (scene == "tube") {
        makers::TubeOptions o;
        options.take("--triangles", o.triangles);
        options.take("--pixels", o.pixels);
        options.take("--ground", o.ground);
        make = [=] { makers::make_tube(output, o); };
    } else if (scene == "stadium") {
        makers::StadiumOptions o;
        options.take("--triangles", o.triangles);
        options.take("--motion", o.motion);
        make = [=] { makers::make_stadium(output, o); };
    } else if (scene == "all") {
        make = [=] { makers::make_all(output); };
    } else {
        throw Error(ErrorKind::usage, "unknown scene", scene, "see make_scenes --help");
    }
    options.require_empty();
    make();
}

}  // namespace

int main(int count, char** arguments) {
    const std::string scene = count > 1 ? arguments[1] : "--help";
    if (scene == "--help" || scene == "-h") {
        std::fputs(kHelp, stdout);
        return count > 1 ? 0 : static_cast<int>(ErrorKind::usage);
    }
    try {
        run(scene, Options(count, arguments));
        return 0;
    } catch (const Error& error) {
        std::fprintf(stderr, "make_scenes: error: %s\n", error.what());
        return error.exit_code();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_scenes: error: %s\n", error.what());
        return static_cast<int>(ErrorKind::internal);
    }
}
