// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "page/page_content.hpp"
#include "page/pages.hpp"

/// Pages as the program writes them.
namespace swept {

std::vector<PageContent::State> pageStates(const std::vector<LabelledState>& states);

/// Adds trajectories, and says whether they are free.
void showTrajectories(PageContent& content, const std::vector<ShownTrajectory>& trajectories);

/// Computes and writes the page of --html, and says so on stdout unless that is JSON. What the
/// robot of `model` looks like is read for it. `checker` may be null: then the world is that of
/// `model`, nothing is judged, and there may be states of the robot's first group, but no motions.
void writePage(const Arguments& args, const Model& model, const Checker* checker,
               PageContent content);

}  // namespace swept
