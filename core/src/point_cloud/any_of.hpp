// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include "point_cloud/event_integral.hpp"

namespace swept::detail {

/// The probability that any of some independent events occurs: 1 - prod(1 - p), by logarithms, so
/// that small probabilities keep their digits and events can be taken out again.
class AnyOf {
 public:
  void add(double p) {
    if (p >= 1.0) {
      ++certain_;
    } else {
      logarithms_ += std::log1p(-p);
    }
  }
  void remove(double p) {
    if (p >= 1.0) {
      --certain_;
    } else {
      logarithms_ -= std::log1p(-p);
    }
  }
  double probability() const { return certain_ > 0 ? 1.0 : 0.0 - std::expm1(logarithms_); }

 private:
  std::size_t certain_ = 0;
  double logarithms_ = 0.0;
};

/// The same for bounds and estimate together.
class AnyOfRanges {
 public:
  void add(const ProbabilityRange& range) {
    lower_.add(range.lower);
    upper_.add(range.upper);
    estimate_.add(range.estimate);
  }
  void remove(const ProbabilityRange& range) {
    lower_.remove(range.lower);
    upper_.remove(range.upper);
    estimate_.remove(range.estimate);
  }
  /// `besides`: upper bound on the probability that something else occurs.
  ProbabilityRange range(double besides) const {
    ProbabilityRange any;
    any.lower = lower_.probability();
    any.upper = std::fmin(1.0, upper_.probability() + besides);
    any.estimate = std::fmin(std::fmax(estimate_.probability(), any.lower), any.upper);
    return any;
  }

 private:
  AnyOf lower_;
  AnyOf upper_;
  AnyOf estimate_;
};

}  // namespace swept::detail
