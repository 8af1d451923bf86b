// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "output/text_output.hpp"
#include "page/page_bodies.hpp"
#include "page/page_frames.hpp"
#include "swept/robot_model/visual_model.hpp"

/// The visual geometry of the robot, which a page can show in place of the collision geometry.
namespace swept {

/// Indices of the links that have visuals.
std::vector<int> linksWithVisuals(const Robot& robot, const VisualModel& visuals);

/// `#rrggbb`.
std::string cssColour(const Colour& colour);

/// One entry for each visual. `frames` must hold all their links. A mesh that is also collision
/// geometry of the link is stored once.
Json visualsJson(const Robot& robot, const VisualModel& visuals, const PageFrames& frames,
                 PageGeometries& geometries);

/// For example `36 shapes, 150000 of 812345 triangles, 2 left out`; empty: nothing to report.
std::string visualsText(const VisualModel& visuals);

}  // namespace swept
