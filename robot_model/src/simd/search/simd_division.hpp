// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simd/kernels/simd_motion.hpp"
#include "simd/search/simd_search.hpp"

namespace swept::detail {

/// The state of one motion's search in single precision.
struct SimdSearch {
  SimdMotion& motion;
  ExactOracle& oracle;
  const ConfirmedContacts& contacts;
  ProofWork& work;
  SimdScratch& scratch;
  int mostIntervals = 0;  ///< to examine
  int examined = 0;       ///< sub-intervals
  /// A body of the world has changed, and some pairs with it are asked about. Most are clearly
  /// apart or in contact: planes are sought between the hulls before exact geometry is asked.
  bool ofChange = false;

  bool isSpent() const { return examined >= mostIntervals; }
  /// m. Inflation of the balls in a sub-interval of this half width.
  float inflation(float half) const { return 0.5F * half * half * motion.acceleration(); }
};

/// Takes from `work.open` what planes between the hulls of two bodies prove. Exact geometry at one
/// time gives their directions, and each serves for all sub-intervals around it. True: a contact
/// settles the search.
bool dividePairs(SimdSearch& search);

}  // namespace swept::detail
