// SPDX-License-Identifier: BSD-3-Clause
#include "certify/pair_oracle.hpp"

#include <utility>

#include "certify/simd_witness.hpp"

namespace swept::detail {

bool PairOracle::start() {
  if (!started_) started_ = query_.start(path_);
  return started_;
}

bool PairOracle::keep(std::optional<Witness> witness) {
  if (!witness) return false;
  contacts_.add(*std::move(witness));
  return true;
}

bool PairOracle::isContact(const SimdContact& contact, double t) {
  const GeometryPair pair = model_.pair(contact.pair);
  if (pair.self) {
    if (!start()) return false;
    query_.moveTo(t, 0.0);
  }
  return keep(simdWitness(model_, query_, pair, contact, t));
}

bool PairOracle::isInside(std::uint32_t pair, std::int32_t point, double t) {
  if (!start()) return false;
  query_.moveTo(t, 0.0);
  const Eigen::Vector3d at =
      query_.placed(pair, model_.simd.hulls->inBody[static_cast<std::size_t>(point)]);
  return keep(pointWitness(model_, pair, at, t));
}

ExactAnswer PairOracle::look(std::uint32_t pair, double t, double half) {
  ExactAnswer look;
  if (effort_.intervals >= model_.options.maxIntervals || !start()) return look;
  query_.moveTo(t, half);
  const PairAnswer answer = query_.prove(pair, half);
  ++effort_.intervals;
  ++(answer.culled ? effort_.culled : effort_.distances);
  if (answer.status == Separation::Contact) {
    look.kind = ExactAnswer::Kind::Contact;
    keep(query_.witness(pair, t, answer));
    return look;
  }
  if (answer.status == Separation::Separated) look.kind = ExactAnswer::Kind::Apart;
  if (answer.status == Separation::Unproven && keep(query_.tubeContact(pair, answer)))
    look.kind = ExactAnswer::Kind::Contact;
  look.directed = !answer.normal.isZero();
  for (int i = 0; i < 3; ++i) look.towards[i] = static_cast<float>(answer.normal[i]);
  return look;
}

bool PairOracle::staysApart(std::uint32_t pair, double t, double half, const MovingPoint& point,
                            double radius) {
  if (effort_.intervals >= model_.options.maxIntervals || !start()) return false;
  ++effort_.intervals;
  ++effort_.distances;
  return query_.staysApartFrom(
      {pair, {{point.x[0], point.x[1], point.x[2]}, {point.g[0], point.g[1], point.g[2]}}, radius},
      t, half);
}

}  // namespace swept::detail
