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
  /// m. Motions that keep more than margin + tolerance are Free. The first contact is found to
  /// within this much relative motion.
  double tolerance = tolerance::kMotion;
  /// In units of t; used instead of `tolerance` if it is reached first.
  double timeTolerance = 0.0;
  /// Cap on the intervals examined; a motion that needs more is Undecided from there on.
  int maxIntervals = tolerance::kMaxIntervals;
};

/// The effort of a query.
struct ContinuousEffort {
  int intervals = 0;             ///< time intervals examined
  std::int64_t volumeTests = 0;  ///< tests of up to eight bounding volumes against another
  std::int64_t leafTests = 0;    ///< tests of pairs of triangles, points and convex bodies
};

/// When two moving shapes first touch, as an interval of t.
struct ContinuousResult {
  Verdict verdict = Verdict::Undecided;  ///< see continuousCollide
  /// Proven: the shapes keep more than the margin on [0, freeUntil). If Free, it is 1 and they do
  /// on [0, 1].
  double freeUntil = 0.0;
  /// The earliest t with a known contact; with freeUntil it encloses the first contact. 1 unless
  /// the verdict is Collision. The two are at most `tolerance` of relative motion or
  /// `timeTolerance` apart, unless the shapes graze each other within the tolerance before: then
  /// freeUntil is before that.
  double contactBy = 1.0;
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, world frame, at contactBy; if Collision
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, world frame, at contactBy; if Collision
  ContinuousEffort effort;                           ///< spent, whatever the verdict
};

/// Memory for queries of one thread. No result depends on its content. It grows with its use; a
/// query that needs no more than earlier ones allocates nothing.
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

/// Finds when two moving shapes with a common clock first touch. Free is proven for every instant
/// of the motion, rounding included. Collision has a witness: two points, one of each shape, at
/// most the margin apart at contactBy. Shapes that overlap at t = 0, however deeply, are in contact
/// at 0. Solids are solids as in distance().
///
/// Undecided: the shapes come closer than margin + tolerance from freeUntil on, and no contact was
/// found in kMaxGrazing such intervals, or in maxIntervals.
///
/// Never throws on finite input. If a pose or option is not finite, the result is Undecided, and
/// freeUntil is where that begins.
ContinuousResult continuousCollide(const Shape& a, const Motion& motionA, const Shape& b,
                                   const Motion& motionB, const ContinuousOptions& options,
                                   ContinuousWorkspace& workspace);
/// The same, with a workspace made for this query.
ContinuousResult continuousCollide(const Shape& a, const Motion& motionA, const Shape& b,
                                   const Motion& motionB, const ContinuousOptions& options = {});

}  // namespace swept
