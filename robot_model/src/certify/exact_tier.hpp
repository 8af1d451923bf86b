// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "certify/pair_oracle.hpp"
#include "proof/confirmed_contacts.hpp"
#include "proof/proof_tier.hpp"

namespace swept::detail {

/// Tier 2: pair by pair on exact geometry, in double precision. It halves intervals until every
/// pair is proven, one is in contact, or one moves too little to tell (after Schwarzer, Saha,
/// Latombe, Adaptive Dynamic Collision Checking, 2005). It looks at each interval by the pairs'
/// distances at its middle and by bounds on their approach; see ApproachBound.
class ExactTier final : public ProofTier {
 public:
  /// `oracle` uses `query`. Adds the work to `effort`. All arguments must outlive this.
  ExactTier(const CheckerModel& model, PairQuery& query, PairOracle& oracle,
            ConfirmedContacts& contacts, WorkspaceData& workspace, Effort& effort)
      : model_(model),
        query_(query),
        oracle_(oracle),
        contacts_(contacts),
        workspace_(workspace),
        effort_(effort) {}

  /// Leaves `work` as it is if the query cannot take the path.
  void prove(ProofWork& work) override;

 private:
  const CheckerModel& model_;
  PairQuery& query_;
  PairOracle& oracle_;
  ConfirmedContacts& contacts_;
  WorkspaceData& workspace_;
  Effort& effort_;
};

}  // namespace swept::detail
