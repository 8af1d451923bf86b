// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <utility>

#include "swept/robot_model/checker_results.hpp"

namespace swept::detail {

/// The contacts of one motion that exact geometry has confirmed. Nothing else in a search knows
/// what was asked for, and this says nothing before the first contact. So every query takes the
/// same steps until then, and all give the same verdict.
class ConfirmedContacts {
 public:
  explicit ConfirmedContacts(MotionQuery wanted) : wanted_(wanted) {}

  /// Keeps the earliest.
  void add(Witness witness) {
    if (witness.t < horizon()) earliest_ = std::move(witness);
  }

  const std::optional<Witness>& earliest() const { return earliest_; }
  bool any() const { return earliest_.has_value(); }
  /// Whether the search is over: there is a contact, and no earlier one is wanted.
  bool settle() const { return any() && wanted_ == MotionQuery::VerdictOnly; }
  /// t of the earliest: nothing that begins there or later matters. Infinite without a contact.
  double horizon() const {
    return earliest_ ? earliest_->t : std::numeric_limits<double>::infinity();
  }

 private:
  const MotionQuery wanted_;
  std::optional<Witness> earliest_;
};

}  // namespace swept::detail
