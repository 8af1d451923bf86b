// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "kinematics/joint_path.hpp"
#include "rounding/error_model.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_kinematics.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// A motion in single precision. Frames and velocities of bodies at the middles of a block's
/// sub-intervals, and bounds that hold in these.
class SimdMotion {
 public:
  /// `joints`: work space for as many as there are bodies. All must outlive this.
  SimdMotion(const SimdModel& model, const KinematicModel& kinematics, const JointPath& path,
             std::span<JointMotion> joints, SimdScratch& scratch)
      : model_(model), kinematics_(kinematics), path_(path), joints_(joints), scratch_(scratch) {}

  /// The whole motion, with the bound on its error. False: the path gives no bounds (see
  /// JointPath::linearize), or it turns so far that single precision is not enough. Later calls
  /// give the same answer.
  bool compile() {
    if (!asked_) compiled_ = compileAll();
    asked_ = true;
    return compiled_;
  }

  /// Frames alone of some bodies, whose ancestors must be among them, at the sub-intervals of the
  /// scratch's block: enough to find a contact.
  void placeFrames(std::span<const int> bodies) {
    if (scratch_.curved) linearizeLanes();
    detail::placeFrames(model_, scratch_.motion, bodies, scratch_.block);
  }
  /// Velocities of bodies whose frames are placed.
  void setVelocities(std::span<const int> bodies) {
    placeVelocities(model_, scratch_.motion, bodies, scratch_.block);
  }

  /// Frames alone of all bodies, at the middles of eight equal sub-intervals. Called again before
  /// place(), it does nothing.
  void placeEighths();

  /// Velocities, and bound(). Called again before place(), it does nothing.
  void setMoving() {
    if (moving_) return;
    moving_ = true;
    placeVelocities(model_, scratch_.motion, model_.allBodies, scratch_.block);
    if (!scratch_.curved) bound();
  }

  /// The bounds on accelerations relative to the model frame. Of a curve, compile() has made them,
  /// and each placement renews them.
  void bound();

  /// The bounds relative to links, which a motion that hits the world does without.
  void boundLinks() {
    // Those of a curve are renewed with each placement.
    if (!scratch_.curved) boundMotionOfLinks(model_, scratch_);
  }

  /// Places bodies at the sub-intervals of the scratch's block. Their ancestors must be among them.
  void place(std::span<const int> bodies) {
    if (scratch_.curved) linearizeLanes();
    placeBodies(model_, scratch_.motion, bodies, scratch_.block);
  }

  const SimdModel& model() const { return model_; }

  /// m per unit t squared, bounds that of all ball centres during the motion; after setMoving().
  float acceleration() const { return acceleration_; }

  /// What its rounding depends on, but for the reach; after compile().
  const MotionExtent& extent() const { return extent_; }

 private:
  bool compileAll();
  void linearizeLanes();
  SimdJointMotion localMotion(std::size_t body) const;

  const SimdModel& model_;
  const KinematicModel& kinematics_;
  const JointPath& path_;
  std::span<JointMotion> joints_;
  SimdScratch& scratch_;
  MotionExtent extent_;
  float acceleration_ = 0.0F;
  bool asked_ = false, compiled_ = false;  ///< by compile()
  bool placed_ = false, moving_ = false;   ///< the eighths
};

/// A single state, without bounds on accelerations. False: a value is not finite, outside its
/// range, or too large for single precision.
bool compileSimdState(const SimdModel& model, const KinematicModel& kinematics,
                      std::span<const double> q, SimdScratch& scratch);

/// Up to eight states, consecutive in `states`, one per lane; remaining lanes repeat the first.
/// False as above if it holds for any of them, and for robots with floating joints.
bool compileSimdStates(const SimdModel& model, const KinematicModel& kinematics,
                       std::span<const double> states, SimdScratch& scratch);

}  // namespace swept::detail
