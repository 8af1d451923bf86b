// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "certify/checker_model.hpp"
#include "constraints/constraint_proof.hpp"
#include "kinematics/curve_path.hpp"
#include "proof/open_work.hpp"
#include "simd/kernels/simd_scratch.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"
#include "swept/core/cloud_parts.hpp"
#include "swept/core/separation.hpp"

namespace swept::detail {

/// A pair that may have the least clearance of a motion.
struct MeasuredPair {
  GeometryPair pair;
  /// Model frame, from a to b: where the two were nearest when they were measured last. Zero: they
  /// were not.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double distance = 0.0;  ///< m, that they had
  double half = 0.0;      ///< of the interval in whose middle that was
  /// Their hulls were clearly nearer than that, as far as is known.
  bool hollow = false;
};

/// A part of a motion that may have its least clearance, and the pairs that may: a range of
/// ClearanceWork::pairs.
struct ClearancePart {
  double begin = 0.0;
  double end = 1.0;
  std::size_t first = 0;
  std::size_t count = 0;
  double excess = 0.0;  ///< m, the least of the pairs' bounds less the least distances then known

  double middle() const { return 0.5 * (begin + end); }
  double half() const { return 0.5 * (end - begin); }
};

/// The parts of a motion that are to be examined yet.
struct ClearanceWork {
  struct Pair {
    std::uint32_t index = 0;  ///< into `measured`
    double lower = 0.0;       ///< m, of its distance over the part
  };
  std::vector<MeasuredPair> measured;
  std::vector<ClearancePart> parts;  ///< a heap: the least excess first
  std::vector<Pair> pairs;

  void clear() {
    measured.clear();
    parts.clear();
    pairs.clear();
  }
};

/// A pair that may be the nearest.
struct PairBound {
  double lower = 0.0;          ///< m
  std::int32_t geometry = -1;  ///< of the robot, with the world; -1: `other` is an index into pairs
  std::int32_t other = 0;      ///< of the world
};

/// An obstacle passes a waypoint.
struct WaypointCrossing {
  double t = 0.0;     ///< in [0, 1]
  double time = 0.0;  ///< s
};

struct WorkspaceData {
  explicit WorkspaceData(const CheckerModel& model);

  std::uint64_t version = 0;  ///< of the model that it fits
  /// The joints around the current t, or over the whole motion if no rate changes.
  std::vector<JointMotion> motion;
  /// At the current t; computed when first asked for.
  std::vector<BodyState> states;
  std::vector<std::int64_t> stateStamps;
  /// Per robot geometry at the current t; computed when first asked for.
  struct Placed {
    std::int64_t stamp = -1;
    Eigen::Vector3d center;  ///< m, model frame
    Eigen::Isometry3d world_from_shape;
    bool posed = false;
  };
  std::vector<Placed> placed;
  std::int64_t stamp = 0;
  /// Bounds of the current `motion`, computed on first use. For a long chain of joints (see
  /// nestedMotionBounds) each geometry's are computed together, in place of
  /// CheckerModel::motionBounds.
  std::vector<PointMotionBound> motionBounds;
  std::vector<std::int64_t> motionBoundStamps;
  std::vector<std::vector<PointMotionBound>> nestedMotionBounds;
  std::int64_t motionStamp = 0;  ///< one for each path
  std::int64_t boundStamp = 0;   ///< one for each `motion`
  double t = 0.0;
  std::vector<CarriedRounding> carried;  ///< per body, of the current motion
  CarriedRounding mostCarried;           ///< no body has more of anything
  std::vector<double> arms;              ///< m, of one travel
  std::vector<Eigen::Vector3d> hints;    ///< per pair, within one motion: last direction found
  std::vector<std::int64_t> hintStamps;
  ProofWork work;                    ///< of the current motion
  std::vector<std::uint32_t> pairs;  ///< to look at, of a state
  SimdScratch simd;
  ClearanceWork clearance;
  std::vector<PairBound> bounds;
  BroadphaseScratch boxes;
  std::vector<CloudPart> cloudParts, waitingParts;  ///< of a cloud, as it passes a link
  /// Full configurations: see KinematicModel. Empty without moving obstacles.
  std::vector<double> from, to;
  std::vector<double> probe;                ///< a configuration
  std::vector<WaypointCrossing> crossings;  ///< of the current motion, in order
  CurveScratch curve;                       ///< of a run of a curve
  ///@{
  /// In a tube: the joints' bounds from q(m) to all of the tube's configurations around m, the
  /// pair's errors, and where a configuration beside the motion is examined.
  std::vector<JointMotion> tubeMotion;
  std::vector<ApproachError> errors;
  ApproachBound tubeBound;
  std::vector<double> tubeState, tubeGradient;
  std::unique_ptr<WorkspaceData> besideMotion;
  ///@}
  std::vector<double> curveBegin, curveEnd;  ///< configurations of a straight run
  ConstraintScratch constraints;
};

/// What is proven of the constraints of a checker.
inline ConstraintQuestion constraintsOf(const CheckerModel& model, WorkspaceData& workspace) {
  return {.constraints = model.constraints,
          .kinematics = model.kinematics,
          .tube = model.tube,
          .tolerance = model.options.tolerance,
          .maxIntervals = model.options.maxIntervals,
          .scratch = workspace.constraints,
          .motion = workspace.motion};
}

}  // namespace swept::detail
