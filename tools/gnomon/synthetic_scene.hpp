// SPDX-License-Identifier: Apache-2.0
// Scenes of `gnomon bench --synthetic`: stacks of triangles, whose heights are the lengths of the lists of a light's view.
#pragma once

#include <cstdint>
#include <gnomon/scene.hpp>
#include <string>
#include <vector>

namespace gnomon::cli {

struct Synthetic {
    enum class Lengths { uniform, zipf, spike } lengths = Lengths::uniform;
    enum class Order { as_is, shuffled, sorted } order = Order::as_is;
    double mean = 8.0;  ///< Triangles of a stack.

    std::string name() const;  ///< "synthetic-zipf-8", "synthetic-zipf-8-shuffled"
};

/// "lengths=uniform|zipf|spike,mean=8,order=as-is|shuffled|sorted", all but lengths optional. Errors: ErrorKind::usage.
Synthetic parse_synthetic(const std::string& text);

/// How many triangles each stack has; their mean is as near to what is asked for as whole numbers are.
std::vector<uint32_t> stack_heights(const Synthetic& synthetic, uint32_t stacks);

/// A square of 16 m is cut into 16 x 16 squares, each of these into two triangles along its diagonal. Over each of these 512
/// lies a stack of horizontal triangles of that shape, between 0.1 m and 2 m above a ground, at equal distances; which stack
/// has which height is drawn with the seed. Triangle j of a stack moves sideways, along +X, -X, +Z or -Z for j mod 4 = 0 to 3,
/// by 1/8 m in the shutter times speed, being over its place in the middle of it. A sun shines straight down, a camera looks
/// from above at 50 degrees. In numbers of triangles they come stack by stack, from below ("as-is"); in an order drawn with the
/// seed ("shuffled"); or nearest the sun first ("sorted").
Scene synthetic_scene(const Synthetic& synthetic, uint32_t seed);

/// Its poses in that many segments. speed 0: it stands still.
std::vector<Pose> synthetic_poses(double speed, uint32_t segments);

}  // namespace gnomon::cli
