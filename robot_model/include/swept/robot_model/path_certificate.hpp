// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "swept/core/verdict.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/configuration.hpp"

namespace swept {

/// The motion from one state of a path to the next.
struct CertifiedSegment {
  MotionCertificate certificate;  ///< by MotionQuery::FirstContact
  /// By kinds of pairs. No value if the verdict is Collision, or it was not requested.
  std::optional<MotionClearance> clearance;
};

/// What is known about a path: a robot's straight motions between configurations.
struct PathCertificate {
  /// The i-th leads from state i to state i + 1.
  std::vector<CertifiedSegment> segments;

  /// Violation if one segment is, else Collision if one is; Free if all are; else Undecided.
  Verdict verdict() const;
  std::size_t count(Verdict verdict) const;  ///< number of segments with this verdict
};

/// Options of certifyPath().
struct PathQuery {
  bool clearances = true;  ///< writeProof() needs them
  unsigned threads = 0;    ///< 0: as many as there are processors
  /// Called between segments with the number of finished ones, on the caller's thread.
  std::function<void(std::size_t done)> progress = {};
};

/// Certificates of all segments of a path from any planner. For a single state, of the motion that
/// stays there. They do not depend on the number of threads. Clearances have the accuracy that
/// `swept` uses: a tenth of CheckerOptions::tolerance, but at least 1e-5 m. Limits are not checked:
/// see Checker::withinLimits() and readPath(). Throws std::invalid_argument for a path without a
/// state, and for a state of another size than the group's.
PathCertificate certifyPath(const Checker& checker, const ConfigurationList& states,
                            const PathQuery& query = {});

}  // namespace swept
