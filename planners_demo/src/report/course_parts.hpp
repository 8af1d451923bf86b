// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "report/asked_method.hpp"
#include "report/length_tally.hpp"
#include "report/stopwatch.hpp"
#include "report/turns.hpp"

namespace swept {

/// Asks all methods when each of the motions, which all collide, does so first. A certified one
/// answers with what it proves free, which ends before the contact, and bounds its error by the
/// contact that it knows, or the motion's end; a discrete one with the first of its states that
/// collides. Errors are in t, times the most that any point of the robot moves per unit of t (m).
void addFirstContacts(LengthTally& tally, std::vector<AskedMethod>& asked, const Checker& truth,
                      const std::vector<ReportMotion>& motions, int passes,
                      const Stopwatch& stopwatch, const ReportTick& tick);

/// Asks certified and discrete methods for the least distance over each of the motions, which are
/// free, once, for that takes milliseconds. The first answer with a proven lower bound, the others
/// with the least of states.
void addClearances(LengthTally& tally, std::vector<AskedMethod>& asked, const Checker& truth,
                   const std::vector<ReportMotion>& motions, const Stopwatch& stopwatch,
                   const ReportTick& tick);

}  // namespace swept
