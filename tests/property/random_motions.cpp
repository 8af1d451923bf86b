// SPDX-License-Identifier: BSD-3-Clause
#include "random_motions.hpp"

#include <algorithm>
#include <cmath>

namespace {
constexpr double kRoom = 1.0;  // m
}

RandomMotions::RandomMotions(const Scenario& scenario, std::uint64_t seed, double skew)
    : scenario_(scenario), random_(seed), skew_(skew) {}

double RandomMotions::uniform(double lower, double upper) {
  return std::uniform_real_distribution<double>(lower, upper)(random_);
}

/// m, a clearance to aim at: from where nothing can be decided any more to where it is easy.
double RandomMotions::nearness() {
  const double margin = scenario_.checker->options().margin;
  return margin + scenario_.checker->options().tolerance * std::pow(10.0, uniform(-0.3, 1.0));
}

RandomMotions::State RandomMotions::anywhere() {
  const oracle::Oracle& judge = *scenario_.oracle;
  State q = judge.arm().home();
  for (const int i : judge.moving()) {
    const oracle::ArmVariable& v = judge.arm().variables()[i];
    const double bound = v.cyclic ? M_PI : kRoom;
    q[i] = std::isfinite(v.lower) ? uniform(v.lower, v.upper) : uniform(-bound, bound);
  }
  for (const oracle::ArmJoint& j : judge.arm().joints()) {
    if (j.type != "planar" && j.type != "floating") continue;
    if (std::count(judge.moving().begin(), judge.moving().end(), j.variable) == 0) continue;
    // Nothing bounds a base that drives or floats: it goes where obstacles are.
    const Eigen::Vector3d place = nearSomething();
    for (int k = 0; k < (j.type == "planar" ? 2 : 3); ++k) q[j.variable + k] = place[k];
    if (j.type == "floating") Eigen::Map<Eigen::Vector4d>(q.data() + j.variable + 3).normalize();
  }
  return q;
}

Eigen::Vector3d RandomMotions::nearSomething() {
  const Eigen::Vector3d offset{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
  const auto& world = scenario_.oracle->world();
  if (world.empty()) return kRoom * offset;
  const auto& pieces =
      world[static_cast<size_t>(uniform(0, static_cast<double>(world.size()) - 1e-9))].pieces;
  const auto& piece =
      pieces[static_cast<size_t>(uniform(0, static_cast<double>(pieces.size()) - 1e-9))];
  const Eigen::Vector3d in{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
  return piece.body_from_piece * (piece.boxCenter + in.cwiseProduct(piece.boxHalf)) + 0.3 * offset;
}

RandomMotions::State RandomMotions::freeState() {
  State q = anywhere();
  for (int tries = 0; tries < 200 && scenario_.oracle->hit(q); ++tries) q = anywhere();
  return q;
}

RandomMotions::State RandomMotions::towards(const State& from, const State& target,
                                            double length) const {
  double squared = 0;
  const auto& variables = scenario_.oracle->arm().variables();
  for (size_t i = 0; i < from.size(); ++i) {
    const double d = target[i] - from[i];
    squared += std::pow(variables[i].cyclic ? std::remainder(d, 2 * M_PI) : d, 2);
  }
  const double whole = std::sqrt(squared);
  return whole <= length ? target : scenario_.oracle->arm().between(from, target, length / whole);
}

RandomMotions::State RandomMotions::lastFree(const State& open, const State& blocked,
                                             double clearance) const {
  double lower = 0, upper = 1;
  const auto& arm = scenario_.oracle->arm();
  while (upper - lower > 1e-5) {
    const double middle = (lower + upper) / 2;
    const State q = arm.between(open, blocked, middle);
    (scenario_.oracle->clearance(q, clearance).upper < clearance ? upper : lower) = middle;
  }
  return arm.between(open, blocked, lower);
}

RandomMotions::State RandomMotions::nearContact(State& open, State& blocked) {
  open = freeState();
  blocked = anywhere();
  for (int tries = 0; tries < 200 && !scenario_.oracle->hit(blocked); ++tries) blocked = anywhere();
  return lastFree(open, blocked, nearness());
}

RandomMotions::Motion RandomMotions::next() {
  const double length = 0.05 * std::pow(4 / 0.05, std::pow(uniform(0, 1), skew_));
  const int kind = count_++ % 4;
  if (kind < 2) {
    const State from = count_ % 8 < 4 ? anywhere() : freeState();
    return {from, towards(from, anywhere(), length)};
  }
  State open, blocked;
  const State from = nearContact(open, blocked);
  if (kind == 2) return {from, towards(from, count_ % 8 < 4 ? blocked : anywhere(), length)};
  // Neighbours of both ends give a second contact with, most often, the same things.
  const double spread = std::min(length, 0.6);
  const State open2 = towards(open, anywhere(), spread);
  const State blocked2 = towards(blocked, anywhere(), spread);
  return {from, lastFree(open2, blocked2, nearness())};
}
