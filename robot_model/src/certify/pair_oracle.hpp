// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "certify/pair_query.hpp"
#include "proof/confirmed_contacts.hpp"
#include "simd/search/simd_search.hpp"

namespace swept::detail {

/// Examines one motion on exact geometry for the SIMD tier.
class PairOracle final : public ExactOracle {
 public:
  PairOracle(const CheckerModel& model, const JointPath& path, PairQuery& query,
             ConfirmedContacts& contacts, Effort& effort)
      : model_(model), path_(path), query_(query), contacts_(contacts), effort_(effort) {}

  /// Gives the path to the query, once. False: the query cannot take it.
  bool start();

  bool isContact(const SimdContact& contact, double t) override;
  bool isInside(std::uint32_t pair, std::int32_t point, double t) override;
  ExactAnswer look(std::uint32_t pair, double t, double half) override;
  bool staysApart(std::uint32_t pair, double t, double half, const MovingPoint& point,
                  double radius) override;

 private:
  bool keep(std::optional<Witness> witness);

  const CheckerModel& model_;
  const JointPath& path_;
  PairQuery& query_;
  ConfirmedContacts& contacts_;
  Effort& effort_;
  bool started_ = false;
};

}  // namespace swept::detail
