// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Goal.h>
#include <ompl/base/PlannerData.h>
#include <ompl/geometric/PathGeometric.h>

#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/path_certificate.hpp"

/// What planners have found: its configurations, and certificates for it.
namespace swept {

/// The states of a path, in order, as configurations of the checker's group. Throws
/// std::invalid_argument when the path is not of that group.
std::vector<std::vector<double>> configurationsOf(const ompl::geometric::PathGeometric& path,
                                                  const Checker& checker);

/// Certificates, by Checker::certifyMotion(), of all segments of a path, in order: one fewer than
/// it has states. They say nothing about bounds. Throws std::invalid_argument when the path is not
/// one of the checker's group.
std::vector<MotionCertificate> certifyPath(const ompl::geometric::PathGeometric& path,
                                           const Checker& checker);

/// Simplifies a path with OMPL's PathSimplifier, as its space information checks motions, for about
/// `time` s; `goal`, if given, lets it shorten the path's end. What comes out is certified anew:
/// the path becomes that only if every segment is proven free and it is not longer, and stays as it
/// was otherwise. Returns the certificates of the path as it is then. Throws as certifyPath, and
/// for a time that is not a positive number.
std::vector<MotionCertificate> simplifyPath(ompl::geometric::PathGeometric& path,
                                            const Checker& checker, double time,
                                            const ompl::base::GoalPtr& goal = nullptr);

/// An edge of a roadmap or tree, with what is known about its motion.
class CertifiedEdge : public ompl::base::PlannerDataEdge {
 public:
  /// Of the motion from the source of the edge to its target.
  explicit CertifiedEdge(MotionCertificate certificate) : certificate_(std::move(certificate)) {}
  /// The caller owns it, as OMPL asks.
  ompl::base::PlannerDataEdge* clone() const override { return new CertifiedEdge(certificate_); }
  /// As certifyEdges found it.
  const MotionCertificate& certificate() const { return certificate_; }

 private:
  MotionCertificate certificate_;
};

/// Makes every edge of a planner's data a CertifiedEdge, with the weight that it had. Returns how
/// many are proven free. Planners that check their edges lazily leave some that are not. Throws
/// std::invalid_argument when the data is not of the checker's group.
///
/// A certificate is of the checker's world and is not for keeping: PlannerDataStorage stores no
/// such edges (of OMPL, only the log says so). Store the data before, and certify what is loaded.
unsigned certifyEdges(ompl::base::PlannerData& data, const Checker& checker);

}  // namespace swept
