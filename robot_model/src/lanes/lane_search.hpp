// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "lanes/lane_model.hpp"
#include "lanes/lane_scratch.hpp"

namespace swept::detail {

struct LaneAnswer {
  enum class Kind : std::uint8_t {
    Free,     ///< all pairs, on all of [0, 1]
    Contact,  ///< the judge said so
    Open,     ///< scratch.rest is what is left
  };
  Kind kind = Kind::Open;
  int intervals = 0;  ///< sub-intervals examined
};

/// Tells whether what the lanes point at is a contact.
class LaneJudge {
 public:
  virtual bool isContact(const LaneContact& contact, double t) = 0;
  virtual bool isContact(const LaneSuspect& suspect, double t) = 0;

 protected:
  ~LaneJudge() = default;
};

/// Of the motion in the scratch. With a judge, stops at a contact.
LaneAnswer searchMotion(const LaneModel& model, LaneJudge* judge, LaneScratch& scratch);
/// Of states: of the motion's begin in all lanes (LaneMode::State), or of eight (States). What is
/// found is in scratch.block: a lane is free if it is neither in `contactLanes` nor has open pairs.
/// Under LaneMode::State the search ends with the first contact.
void searchStates(const LaneModel& model, LaneMode mode, bool contacts, LaneScratch& scratch);
/// Puts the open pairs of a lane into scratch.restArena.
void takeOpen(int lane, LaneScratch& scratch);

}  // namespace swept::detail
