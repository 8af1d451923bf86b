// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateSampler.h>
#include <ompl/base/StateSpace.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace swept::detail {

/// Draws states that are spread evenly: a low-discrepancy sequence, uniform in the measure of the
/// space. In the unit cube each step adds the square roots of the first primes, modulo 1 (R.
/// Richtmyer, The evaluation of definite integrals, and a quasi-Monte-Carlo method based on the
/// properties of algebraic numbers, 1951). Spaces may consist of real vectors, SO(2) and SO(3); of
/// others, the space's own sampler draws, from all of the space.
class SpreadSampler {
 public:
  SpreadSampler(const ompl::base::StateSpacePtr& space, std::uint32_t seed);

  /// From all of the space.
  void sample(ompl::base::State* state);
  /// From the box around two states: no value of a real vector or SO(2) is farther than `margin`
  /// from those between theirs. Rotations are from all of SO(3).
  void sampleAround(const ompl::base::State* from, const ompl::base::State* to, double margin,
                    ompl::base::State* state);

 private:
  /// A space that does not consist of others.
  struct Part {
    enum class Kind : std::uint8_t { Vector, Turn, Rotation } kind;
    std::vector<unsigned> where;     ///< component of the space, of that component ...
    std::vector<double> low, width;  ///< of a vector
  };

  /// Of a box; null states: all of the space.
  struct Box {
    const ompl::base::State* from = nullptr;
    const ompl::base::State* to = nullptr;
    double margin = 0.0;
  };

  bool addParts(const ompl::base::StateSpace& space, std::vector<unsigned>& where);
  void sampleIn(const Box& box, ompl::base::State* state);

  ompl::base::StateSamplerPtr others_;  ///< null: the sequence draws
  std::vector<Part> parts_;
  std::vector<double> steps_;
  std::vector<double> place_;  ///< in the unit cube
};

}  // namespace swept::detail
