// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "curve.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace trajectories {

/// What was learned of one curve besides its faults.
struct Judged {
  std::size_t samples = 0;  ///< states
  /// m. Of a Free curve: the least signed clearance, less the margin, of the configurations of the
  /// tube that were measured.
  double leastRoom = 1.0;
};

/// Holds answers about curves against states of the stage's plain checker.
class Judge {
 public:
  /// `most`: samples of one curve; 0: as many as there are every millisecond and milliradian.
  Judge(const Stage& stage, std::size_t most, Random& random);

  /// What is wrong with a certificate; empty: nothing that is known.
  std::vector<std::string> faultsOf(const RandomCurve& curve, const swept::TrajectoryQuery& query,
                                    const swept::TrajectoryCertificate& found, Judged& judged);

 private:
  using State = std::vector<double>;
  void fault(const std::string& what, double t, const State& q);
  State at(double t) const;
  /// With the time of moving obstacles.
  void complete(double t, State& q) const;
  /// Samples [begin, end) and displaces them.
  void sample(double end, Judged& judged);
  void ask(double end);
  /// Goes down the clearance from the narrowest of some places.
  void climb(double end, Judged& judged);
  void judgeContact(const swept::TrajectoryContact& contact);
  void judgeUndecided(const swept::TrajectoryPlace& place);

  const Stage& stage_;
  const std::size_t most_;
  Random& random_;
  swept::Workspace workspace_;
  const RandomCurve* curve_ = nullptr;
  double clock_ = 0.0;
  std::vector<std::string> faults_;
  State states_;
  std::vector<double> times_;
};

/// Limits that a certificate lists against samples of values and rates.
std::vector<std::string> limitFaults(const Stage& stage, const RandomCurve& curve,
                                     const swept::RateLimits& limits,
                                     const swept::TrajectoryCertificate& found);

}  // namespace trajectories
