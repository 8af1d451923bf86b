// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "acm/link_pieces.hpp"

namespace swept::detail {

/// Searches values of a chain's variables at which two links are in contact. It proves nothing
/// else.
class ContactSearch {
 public:
  using Values = std::vector<double>;

  /// All must outlive this. `place` starts from the configuration that the other variables keep.
  ContactSearch(const LinkPieces& a, const LinkPieces& b, const LinkChain& chain, double margin,
                LinkChain::Place& place)
      : a_(a), b_(b), chain_(chain), margin_(margin), place_(place) {}

  bool isContact(const Values& values);
  /// The first of this many random values within the limits at which the two are in contact.
  std::optional<Values> findContact(int samples, std::uint64_t seed);
  /// The same, for values at which they are not in contact.
  std::optional<Values> findApart(int samples, std::uint64_t seed);
  /// Values in contact, found by descending on the distance from these values and from the nearest
  /// of those that findContact tested.
  std::optional<Values> descend(const Values& start);
  double least() const { return least_; }  ///< m, of all distances computed; infinity without any

 private:
  struct Candidate {
    double distance;  ///< m
    Values values;
  };
  bool canSample() const;
  double distanceAt(const Values& values, double enough);
  void keepNearest(double distance, const Values& values);
  Candidate descendFrom(Candidate start);

  const LinkPieces& a_;
  const LinkPieces& b_;
  const LinkChain& chain_;
  const double margin_;
  LinkChain::Place& place_;
  std::vector<Candidate> nearest_;  ///< nearest first
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace swept::detail
