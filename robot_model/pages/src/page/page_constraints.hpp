// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// CheckerOptions::constraints as a page shows them: a list. Of each the words in which
/// `swept verify` says it (`text`), in short (`name`), and the numbers from which the page computes
/// its value: links as indices into the page's tree, lengths in m, angles in rad, poses as position
/// and quaternion x, y, z, w; null: without limit.
Json pageConstraintsJson(const Checker& checker);

}  // namespace swept
