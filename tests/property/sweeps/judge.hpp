// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gap.hpp"
#include "sweep.hpp"

namespace sweeps {

/// What one answer showed.
struct Judgement {
  std::vector<std::string> faults;
  int samples = 0;
  double leastGap = INFINITY;  ///< m less the margin, of the samples proven free
  /// Where a contact is known at t, deeper than rounding.
  bool contact = false;
  /// m less the margin, in tolerances: how far apart the bodies were where the proof ended.
  double stop = -INFINITY;
  /// In tolerances: relative motion between freeUntil and contactBy, of straight crossings.
  std::optional<double> width;
};

/// Holds a result against what is known about the sweep.
///
/// Rounding: the library speaks of the motions as real numbers, which it and the tests work out
/// from the same doubles each in its own way, some 1e-16 of the coordinates apart. Points that are
/// within the margin by more than `allowance`, 1e-14 of the coordinates, are a contact for certain;
/// so are bodies that still overlap when one is shifted by it either way along each axis.
class Judge {
 public:
  explicit Judge(const Sweep& sweep);
  Judgement judge(const swept::ContinuousResult& result, Random& random);

 private:
  double gapAt(double t);
  bool within(double t);
  bool decidable(const swept::ContinuousResult& result) const;
  void checkNumbers(const swept::ContinuousResult& result);
  void checkKnown(const swept::ContinuousResult& result);
  void checkWitness(const swept::ContinuousResult& result);
  void checkStop(const swept::ContinuousResult& result);
  void checkUndecided(const swept::ContinuousResult& result, Random& random);
  void refute(double until, Random& random);
  void lookAt(double t);
  /// The t in [low, high] where golden sections end up, and the gap there (m).
  std::pair<double, double> descend(double low, double high);
  void fault(const std::string& what);

  const Sweep& sweep_;
  Gap gap_;
  double allowance_;  ///< m
  Judgement found_;
};

}  // namespace sweeps
