// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "simd/compile/simd_field.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// The result of exact geometry for a pair at one time.
struct ExactAnswer {
  enum class Kind : std::uint8_t {
    Open,
    Contact,  ///< at t
    Apart,    ///< on all of [t - half, t + half]
  };
  Kind kind = Kind::Open;
  bool directed = false;  ///< `towards` is known
  float towards[3] = {};  ///< unit, model frame: from the first body to the second
};

/// Exact geometry for the SIMD tier, at one time of a motion. It adds confirmed contacts to the
/// search's ConfirmedContacts.
class ExactOracle {
 public:
  /// Whether a contact found in single precision is one.
  virtual bool isContact(const SimdContact& contact, double t) = 0;
  /// Whether a point of SimdHulls::inBody lies in the obstacle of the pair.
  virtual bool isInside(std::uint32_t pair, std::int32_t point, double t) = 0;
  virtual ExactAnswer look(std::uint32_t pair, double t, double half) = 0;
  /// Whether the pair's link stays apart, by the pair's margin, on [t - half, t + half] from all of
  /// the obstacle, a cloud, that is within `radius` (m) of the points x +- g. False: not proven.
  virtual bool staysApart(std::uint32_t pair, double t, double half, const MovingPoint& point,
                          double radius) = 0;

 protected:
  ~ExactOracle() = default;
};

}  // namespace swept::detail
