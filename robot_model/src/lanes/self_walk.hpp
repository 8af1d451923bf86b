// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "lanes/lane_model.hpp"
#include "lanes/lane_scratch.hpp"

namespace swept::detail {

/// Proves links apart from each other on all sub-intervals of a block, and puts pairs that are not
/// into its open ones. Returns true if it stopped at a contact.
///
/// Lemma: in the frame of a body that carries both, with angular velocity w, distances are the
/// same. There the difference d of two ball centres has the velocity v_B - v_A - w x d (written
/// along the model frame's axes at m) and a second derivative of at most A_A + A_B, relative to
/// that frame; as in world_walk.hpp it stays within h^2 (A_A + A_B) / 2 of the segment of what it
/// does at constant velocity, whose distance from the origin bounds theirs.
///
/// All pairs.
bool walkSelf(const LaneModel& model, LaneScratch& scratch);
/// Only this pair, in these lanes.
bool walkPair(const LaneModel& model, std::uint32_t pair, std::uint32_t lanes,
              LaneScratch& scratch);

}  // namespace swept::detail
