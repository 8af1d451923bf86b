// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Goal.h>
#include <ompl/base/PlannerData.h>
#include <ompl/geometric/PathGeometric.h>

#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/path_certificate.hpp"

/// Paths and roadmaps of planners: their configurations and certificates.
namespace swept {

/// The states of a path, in order, as configurations of the checker's group (rad, m). Throws
/// std::invalid_argument if the path is not of that group.
std::vector<std::vector<double>> configurationsOf(const ompl::geometric::PathGeometric& path,
                                                  const Checker& checker);

/// Certificates, by Checker::certifyMotion(), of all segments of a path, in order: one fewer than
/// it has states. They say nothing about bounds. Throws std::invalid_argument when the path is not
/// one of the checker's group.
std::vector<MotionCertificate> certifyPath(const ompl::geometric::PathGeometric& path,
                                           const Checker& checker);

/// Simplifies a path with OMPL's PathSimplifier, using the motion validator of its space
/// information, for about `time` s. `goal`, if given, lets it shorten the path's end. The
/// simplified path is certified anew. It replaces the path only if every segment is proven free and
/// it is not longer. Returns the certificates of the resulting path. Throws as certifyPath does,
/// and for a time that is not a positive number.
std::vector<MotionCertificate> simplifyPath(ompl::geometric::PathGeometric& path,
                                            const Checker& checker, double time,
                                            const ompl::base::GoalPtr& goal = nullptr);

/// How shortenPath() works.
struct ShorteningOptions {
  int rounds = 3;            ///< of cutting all corners; fewer if one cuts none
  double leastGain = 0.005;  ///< share of the length; a cut that gains less is not made
};

/// Shortens a path, using the motion validator of its space information. The result depends on
/// nothing else. It takes a few tens of motions for a path of ten states, far fewer than OMPL's
/// PathSimplifier, and finds paths that are as short.
///
/// First each state is joined with the last one that it has a valid motion to. Then, in rounds,
/// each corner is cut: from a point of the motion before it to one of the motion after it, equally
/// far from the corner. Of the distances 1/4, 1/2 and 3/4 of the shorter motion, it takes the
/// largest that bisection finds. Motions that are kept are not asked about again. All others are:
/// if one that a cut has shortened is refused, which happens right beside a contact, the path stays
/// as it was before the first round.
void shortenPath(ompl::geometric::PathGeometric& path, const ShorteningOptions& options = {});

/// An edge of a roadmap or tree, with the certificate of its motion.
class CertifiedEdge : public ompl::base::PlannerDataEdge {
 public:
  /// `certificate`: of the motion from the source of the edge to its target.
  explicit CertifiedEdge(MotionCertificate certificate) : certificate_(std::move(certificate)) {}
  /// A copy that the caller owns, as OMPL requires.
  ompl::base::PlannerDataEdge* clone() const override { return new CertifiedEdge(certificate_); }
  /// The certificate from certifyEdges().
  const MotionCertificate& certificate() const { return certificate_; }

 private:
  MotionCertificate certificate_;
};

/// Turns every edge of a planner's data into a CertifiedEdge with the same weight. Returns how many
/// are proven free. Planners that check their edges lazily leave some that are not. Throws
/// std::invalid_argument if the data is not of the checker's group.
///
/// A certificate holds only for the checker's world, and PlannerDataStorage does not store such
/// edges (OMPL only logs this). Store the data before, and certify the loaded data.
unsigned certifyEdges(ompl::base::PlannerData& data, const Checker& checker);

}  // namespace swept
