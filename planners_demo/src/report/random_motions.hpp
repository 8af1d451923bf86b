// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "report/report.hpp"
#include "report/report_worlds.hpp"

namespace swept {

/// Random motions of a world. A motion starts at a uniformly random state and goes towards another
/// one for a length whose logarithm is uniformly random, from 2 % to all of the space's maximum
/// extent, or to that state if it is nearer; both ends are drawn until they are proven free. They
/// depend on the seed of OMPL's random numbers. Throws UsageError when no free state is found.
class RandomMotions {
 public:
  RandomMotions(const ReportWorld& world, const Checker& checker);
  ~RandomMotions();
  RandomMotions(const RandomMotions&) = delete;
  RandomMotions& operator=(const RandomMotions&) = delete;

  ReportMotion next();
  /// A uniformly random state, free or not.
  std::vector<double> state();
  /// A uniformly random one of those that are proven free.
  std::vector<double> freeState();

 private:
  struct Space;
  bool isFree(const std::vector<double>& q);

  const ReportWorld& world_;
  const Checker& checker_;
  Workspace workspace_;
  std::unique_ptr<Space> space_;
};

}  // namespace swept
