// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "output/text_output.hpp"
#include "page/page_bodies.hpp"
#include "page/page_frames.hpp"
#include "swept/robot_model/visual_model.hpp"

/// What the robot looks like, for the page's switch between that and what is proven.
namespace swept {

/// Indices of the links that have visuals.
std::vector<int> linksWithVisuals(const Robot& robot, const VisualModel& visuals);

/// `#rrggbb`.
std::string cssColour(const Colour& colour);

/// One entry for each visual; `frames` has all their links. A mesh that the link is also checked
/// with is in the page once.
Json visualsJson(const Robot& robot, const VisualModel& visuals, const PageFrames& frames,
                 PageGeometries& geometries);

/// `36 shapes, 150000 of 812345 triangles, 2 left out`; empty: there is nothing to say.
std::string visualsText(const VisualModel& visuals);

}  // namespace swept
