// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "certify/pair_query.hpp"
#include "simd/search/simd_search.hpp"

namespace swept::detail {

/// Looks at one motion on exact geometry, where the lane tier asks for it. Effort and the earliest
/// witness go to the certificate.
class PairOracle final : public ExactOracle {
 public:
  PairOracle(const CheckerModel& model, const JointPath& path, PairQuery& query,
             MotionCertificate& certificate)
      : model_(model), path_(path), query_(query), certificate_(certificate) {}

  /// Has the query take the motion, once. False: nothing can be said about it.
  bool start();

  bool isContact(const SimdContact& contact, double t) override;
  bool isInside(std::uint32_t pair, std::int32_t point, double t) override;
  ExactAnswer look(std::uint32_t pair, double t, double half) override;

 private:
  bool keep(std::optional<Witness> witness);

  const CheckerModel& model_;
  const JointPath& path_;
  PairQuery& query_;
  MotionCertificate& certificate_;
  bool started_ = false;
};

}  // namespace swept::detail
