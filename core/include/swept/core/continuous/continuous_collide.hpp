// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "swept/core/continuous/motion.hpp"
#include "swept/core/shapes.hpp"
#include "swept/core/tolerances.hpp"
#include "swept/core/verdict.hpp"

namespace swept {

/// What counts as contact, and how exactly its time is wanted.
struct ContinuousOptions {
  double margin = 0.0;  ///< m, >= 0. Closer than this, or as close, is contact.
  /// m. Motions that keep more than margin + tolerance are Free; the first contact is found to
  /// within this much relative motion.
  double tolerance = tolerance::kMotion;
  /// In units of t; instead of `tolerance` where it is reached first.
  double timeTolerance = 0.0;
  /// Cap on the intervals examined; a motion that needs more is Undecided from there on.
  int maxIntervals = tolerance::kMaxIntervals;
};

/// What a query took.
struct ContinuousEffort {
  int intervals = 0;             ///< of time
  std::int64_t volumeTests = 0;  ///< groups of up to eight bounding volumes against another
  std::int64_t leafTests = 0;    ///< triangles, points and convex bodies, pairs of them
};

/// When two moving shapes first touch, as an interval of t.
struct ContinuousResult {
  Verdict verdict = Verdict::Undecided;  ///< see continuousCollide
  /// Proven: the shapes keep more than the margin on [0, freeUntil), and on [0, 1] if Free (it is 1
  /// then).
  double freeUntil = 0.0;
  /// The earliest t with a known contact; with freeUntil it encloses the first contact. 1 unless
  /// the verdict is Collision. The two are at most `tolerance` of relative motion or
  /// `timeTolerance` apart, but where the shapes graze each other within the tolerance before: then
  /// freeUntil is from before that.
  double contactBy = 1.0;
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, world frame, at contactBy; if Collision
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, world frame, at contactBy; if Collision
  ContinuousEffort effort;                           ///< spent, whatever the verdict
};

/// Memory for queries of one thread. No result depends on what it held before. It grows with what
/// it is used for; a query that needs no more than earlier ones allocates nothing.
class ContinuousWorkspace {
 public:
  ContinuousWorkspace();
  ContinuousWorkspace(ContinuousWorkspace&&) noexcept;
  ContinuousWorkspace& operator=(ContinuousWorkspace&&) noexcept;
  ~ContinuousWorkspace();

  struct Data;
  /// For the queries.
  Data& data() { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

/// When do two shapes that both move on a common clock first touch? Free is proven for every
/// instant of the motion, rounding included; Collision has a witness: two points, one of each, at
/// most the margin apart at contactBy. What overlaps at t = 0, however deeply, is in contact at 0.
/// Solids are solids here as in distance().
///
/// Undecided: the shapes come closer than margin + tolerance from freeUntil on, and no contact was
/// found in kMaxGrazing intervals like that one, or in maxIntervals.
///
/// Never throws on finite input; with a pose or option that is not finite the result is Undecided
/// with freeUntil where that begins.
ContinuousResult continuousCollide(const Shape& a, const Motion& motionA, const Shape& b,
                                   const Motion& motionB, const ContinuousOptions& options,
                                   ContinuousWorkspace& workspace);
/// The same, with a workspace made for this query.
ContinuousResult continuousCollide(const Shape& a, const Motion& motionA, const Shape& b,
                                   const Motion& motionB, const ContinuousOptions& options = {});

}  // namespace swept
