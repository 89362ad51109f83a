// SPDX-License-Identifier: Apache-2.0
// Which shells count as closed in a frame.
#pragma once

#include "stages/pose.hpp"
#include "views/view.hpp"

namespace gnomon {

/// Of each shell 1 where neither the rays of the camera nor those of a spot or point light can start in it during the shutter,
/// else 0; then a 0 for the triangles of none: Geometry::closed.
std::vector<uint32_t> closed_shells(const Scene& scene, const std::vector<Pose>& poses, const GeometryBounds& bounds,
                                    const View& camera);

/// What a view's rays start on: its near plane as far as the image goes; where it has an eye, what lies between the two.
class Eye {
public:
    explicit Eye(const View& view);
    Eye(Eye&&) noexcept;
    ~Eye();

    /// May something in the box, all the time between two neighbouring keys or more, touch it? If in doubt, yes.
    bool may_be_reached(const Bounds& box) const;

private:
    struct Segment;
    std::vector<Segment> segments_;  ///< Those whose keys differ from the ones before.
};

}  // namespace gnomon
