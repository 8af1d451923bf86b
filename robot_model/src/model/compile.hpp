// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept::detail {

struct GeometryPair;
struct MotionBoundSlot;
struct PairModel;

/// The moving frames, and all geometry of the robot, of its attached bodies and of the world. Parts
/// that are the same in `like` (may be null; see compileGeometry) are taken from there. Throws
/// std::invalid_argument as the constructor of Checker does for attached bodies.
void compileBodies(const PairModel* like, PairModel& model);

/// PairModel::tube of CheckerOptions::tracking. Throws std::invalid_argument as the constructor of
/// Checker does.
void compileTube(PairModel& model);

/// m. How far the tube's configurations move points of a geometry, by joints of its path from
/// MotionBoundSlot::firstJoint on; infinity: no bound is known.
double tubeReach(const PairModel& model, const MotionBoundSlot& slot);

/// GeometryPair::tube of all pairs.
void boundTube(PairModel& model);

/// The checked pairs of the model's geometry, with their margins, and the lists of pairs of bodies.
/// Throws std::invalid_argument for a rule about an unknown body.
void compilePairs(PairModel& model);

/// A pair with this piece of the world of the geometry that `like` is a pair of, or one of
/// PairModel::likeWorldPairs.
GeometryPair worldPair(const PairModel& model, const GeometryPair& like, int worldGeometry);

/// Finds the pairs of links that never meet within the limits of the robot's joints, with a small
/// budget for each: BodyPair::never. `like`: as for compileGeometry; then nothing is proven anew.
void findNever(const PairModel* like, PairModel& model);

}  // namespace swept::detail
