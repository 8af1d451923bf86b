// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "proof/open_work.hpp"

namespace swept::detail {

/// A way to prove one motion. A search asks its tiers in turn, the cheapest first, each about what
/// those before it have left open.
class ProofTier {
 public:
  /// Takes from `work` what it proves, and keeps the contacts that it finds in the search's
  /// ConfirmedContacts. Of what is behind the earliest of these, anything may be left. Returns
  /// early, with `work` as it is, where it has nothing to say and where the contacts settle the
  /// search.
  virtual void prove(ProofWork& work) = 0;

 protected:
  ~ProofTier() = default;
};

}  // namespace swept::detail
