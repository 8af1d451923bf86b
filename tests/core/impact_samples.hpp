// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "impact_oracle.hpp"

/// Queries whose answer is known exactly, because every coordinate is a small integer times a power
/// of two.
namespace swept::test {

enum class ImpactTrait {
  Edges,
  Grazing,        ///< the touching points do not approach each other
  Coplanar,       ///< everything stays in one plane
  Flat,           ///< a triangle without area, parallel edges; all the time
  FlatAtContact,  ///< the same, but only then
  Point,          ///< a triangle that is a point, edges of no length
  Still,          ///< nothing moves
  Carried,        ///< all move alike
  Shared,         ///< a point of one feature is one of the other, at contact
  Rim,            ///< contact on a corner or an edge of the face, at an end of the edges
  AtStart,
  AtEnd,
  Apart,  ///< contact is by separation
  Huge,
  Tiny,
  FarAway,     ///< far from the origin
  MixedSizes,  ///< features a million times larger than the motion, or the other way round
  NoTolerance,
  Count
};

using ImpactTraits = std::bitset<static_cast<std::size_t>(ImpactTrait::Count)>;

struct KnownImpact {
  ImpactQuery query;
  ImpactTraits traits;
  std::optional<double> contact;  ///< a t with contact; else the features are known to be apart
};

class ImpactSampler {
 public:
  explicit ImpactSampler(unsigned seed) : random_(seed) {}

  KnownImpact inContact();
  KnownImpact apart();

 private:
  using Cell = Eigen::Matrix<std::int64_t, 3, 1>;
  /// Integer vectors across each other; the first has an integer length.
  struct Frame {
    Cell normal, first, second;
    std::int64_t length;
  };

  std::int64_t pick(std::int64_t least, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(random_);
  }
  bool chance(int percent) { return pick(1, 100) <= percent; }
  Cell cell(std::int64_t reach) {
    return {pick(-reach, reach), pick(-reach, reach), pick(-reach, reach)};
  }
  Cell inPlane(const Frame& f, std::int64_t reach) {
    return pick(-reach, reach) * f.first + pick(-reach, reach) * f.second;
  }
  std::int64_t reach() {
    static constexpr std::array<std::int64_t, 5> kReaches{1, 2, 10, 1000, 1 << 16};
    return kReaches[pick(0, 4)];
  }
  Frame frame();
  bool draw(ImpactTrait trait, int percent);
  bool has(ImpactTrait trait) const { return traits_[static_cast<std::size_t>(trait)]; }
  KnownImpact finish(bool edges, const std::array<Cell, 4>& start, const std::array<Cell, 4>& end,
                     std::int64_t separation, std::int64_t tolerance);

  std::mt19937_64 random_;
  ImpactTraits traits_;
};

inline ImpactSampler::Frame ImpactSampler::frame() {
  static const std::array<Frame, 5> kFrames{{
      {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1},
      {{1, 0, 0}, {0, 1, 1}, {0, 1, -1}, 1},
      {{3, 4, 0}, {0, 0, 1}, {4, -3, 0}, 5},
      {{1, 2, 2}, {2, 1, -2}, {2, -2, 1}, 3},
      {{2, 3, 6}, {3, -6, 2}, {6, 2, -3}, 7},
  }};
  return kFrames[pick(0, 4)];
}

inline bool ImpactSampler::draw(ImpactTrait trait, int percent) {
  const bool drawn = chance(percent);
  traits_[static_cast<std::size_t>(trait)] = drawn;
  return drawn;
}

/// From integers to metres, somewhere, in some size.
inline KnownImpact ImpactSampler::finish(bool edges, const std::array<Cell, 4>& start,
                                         const std::array<Cell, 4>& end, std::int64_t separation,
                                         std::int64_t tolerance) {
  const Cell offset = draw(ImpactTrait::FarAway, 20) ? cell(std::int64_t{1} << 46) : Cell(0, 0, 0);
  int power = -20;
  if (draw(ImpactTrait::Huge, 8)) {
    power = static_cast<int>(pick(30, 960));
  } else if (draw(ImpactTrait::Tiny, 8)) {
    power = -static_cast<int>(pick(50, 960));
  }
  KnownImpact known;
  known.query.edges = edges;
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      known.query.points[i].start[axis] =
          std::ldexp(static_cast<double>(start[i][axis] + offset[axis]), power);
      known.query.points[i].end[axis] =
          std::ldexp(static_cast<double>(end[i][axis] + offset[axis]), power);
    }
  }
  known.query.options.separation = std::ldexp(static_cast<double>(separation), power);
  known.query.options.tolerance = std::ldexp(static_cast<double>(tolerance), power);
  known.traits = traits_;
  return known;
}

/// Contact is made where and when it is wanted, and the motion goes through it: positions at
/// contact, less and plus velocities times integers.
inline KnownImpact ImpactSampler::inContact() {
  traits_.reset();
  const bool edges = draw(ImpactTrait::Edges, 50);
  const Frame f = frame();
  const bool coplanar = draw(ImpactTrait::Coplanar, 15);
  const std::int64_t steps = std::int64_t{1} << pick(0, 12);
  std::int64_t at = pick(0, steps);
  if (draw(ImpactTrait::AtStart, 6))
    at = 0;
  else if (draw(ImpactTrait::AtEnd, 6))
    at = steps;

  std::int64_t shape = reach();
  std::int64_t speed = reach();
  if (draw(ImpactTrait::MixedSizes, 10)) {
    (chance(50) ? shape : speed) <<= 20;
    if (speed > (1 << 20)) speed = std::int64_t{1} << 24;
  }
  const auto vector = [&](std::int64_t most) { return coplanar ? inPlane(f, most) : cell(most); };

  // Shares of the touching point, in eighths: of the face's corners, or of both edges' ends.
  std::array<std::int64_t, 4> share{};
  const bool rim = draw(ImpactTrait::Rim, 25);
  if (edges) {
    share[1] = rim ? 8 * pick(0, 1) : pick(1, 7);
    share[0] = 8 - share[1];
    share[3] = rim && chance(50) ? 8 * pick(0, 1) : pick(1, 7);
    share[2] = 8 - share[3];
  } else {
    share[1] = rim ? 8 * pick(0, 1) : pick(1, 6);
    share[2] = rim ? (8 - share[1]) * pick(0, 1) : pick(1, 7 - share[1]);
    if (rim && chance(50)) share = {0, 0, pick(0, 8), 0};
    share[3] = 8 - share[1] - share[2];
  }

  // How many multiples of one direction the ends are away from where the feature begins.
  const bool flat = draw(ImpactTrait::Flat, 15);
  const bool flatThen = !flat && draw(ImpactTrait::FlatAtContact, 10);
  const bool point = draw(ImpactTrait::Point, 10);
  const bool still = draw(ImpactTrait::Still, 6);
  const bool carried = !still && draw(ImpactTrait::Carried, 6);
  const Cell line = vector(shape);
  const Cell turn = vector(speed);
  std::array<Cell, 4> place;
  std::array<Cell, 4> velocity;
  const std::array<int, 4> origin =
      edges ? std::array<int, 4>{0, 0, 2, 2} : std::array<int, 4>{0, 1, 1, 1};
  for (int i = 0; i < 4; ++i) {
    const int o = origin[i];
    place[i] = 8 * vector(shape);
    velocity[i] = 8 * vector(speed);
    if (o == i) continue;
    const std::int64_t multiple = pick(-3, 3);
    if (flat || flatThen) place[i] = place[o] + 8 * multiple * line;
    if (flat) velocity[i] = velocity[o] + 8 * multiple * turn;
    if (point && (!edges || i == 1 || chance(50))) {
      place[i] = place[o];
      velocity[i] = velocity[o];
    }
  }

  // The first feature is put where its touching point meets the other's.
  std::int64_t separation = 0;
  Cell away(0, 0, 0);
  if (draw(ImpactTrait::Apart, 40)) {
    const std::int64_t units = pick(1, shape);
    separation = units * f.length;
    away = units * f.normal;
  }
  const auto middle = [&](const std::array<Cell, 4>& of, int from, int to) {
    Cell sum(0, 0, 0);
    for (int i = from; i < to; ++i) sum += share[i] * (of[i] / 8);
    return sum;
  };
  const int firsts = edges ? 2 : 1;
  if (!edges) share[0] = 8;
  const Cell shift = middle(place, firsts, 4) + away - middle(place, 0, firsts);
  for (int i = 0; i < firsts; ++i) place[i] += shift;
  if (draw(ImpactTrait::Grazing, 30)) {
    // Across the direction of the distance, or along the face or an edge.
    const Cell along = separation > 0 ? inPlane(f, speed) : Cell((place[3] - place[2]) / 8);
    const Cell change = middle(velocity, firsts, 4) + along - middle(velocity, 0, firsts);
    for (int i = 0; i < firsts; ++i) velocity[i] += change;
  }
  if (draw(ImpactTrait::Shared, 10)) {
    for (int i = firsts - 1; i >= 0; --i) place[i] += place[firsts] + away - place[0];
  }
  for (int i = 0; i < 4; ++i) {
    if (still) velocity[i] = Cell(0, 0, 0);
    if (carried) velocity[i] = velocity[0];
  }

  std::array<Cell, 4> start;
  std::array<Cell, 4> end;
  for (int i = 0; i < 4; ++i) {
    start[i] = place[i] - at * velocity[i];
    end[i] = start[i] + steps * velocity[i];
  }
  static constexpr std::array<std::int64_t, 3> kTolerances{1, 16, 1000};
  const std::int64_t tolerance = draw(ImpactTrait::NoTolerance, 10) ? 0 : kTolerances[pick(0, 2)];
  KnownImpact known = finish(edges, start, end, separation, tolerance);
  known.contact = static_cast<double>(at) / static_cast<double>(steps);
  const auto kind = pick(0, 9);
  if (kind == 0) known.query.options.before = *known.contact;
  if (kind == 1) known.query.options.before = std::min(1.0, *known.contact + 0.125);
  return known;
}

/// One feature stays on one side of a slab that is wider than separation and tolerance, the other
/// on the other, most of the corners on its faces.
inline KnownImpact ImpactSampler::apart() {
  traits_.reset();
  const bool edges = draw(ImpactTrait::Edges, 50);
  const Frame f = frame();
  std::int64_t shape = reach();
  if (draw(ImpactTrait::MixedSizes, 10)) shape <<= 20;
  const std::int64_t deep = chance(50) ? 0 : reach();
  std::int64_t separation = 0;
  if (draw(ImpactTrait::Apart, 50)) separation = pick(1, reach());
  static constexpr std::array<std::int64_t, 3> kTolerances{1, 16, 1000};
  const std::int64_t tolerance = draw(ImpactTrait::NoTolerance, 10) ? 0 : kTolerances[pick(0, 2)];
  const std::int64_t width = separation + tolerance + 1;
  const bool flat = draw(ImpactTrait::Flat, 15);
  const bool point = draw(ImpactTrait::Point, 10);
  const bool still = draw(ImpactTrait::Still, 6);
  const int firsts = edges ? 2 : 1;
  std::array<Cell, 4> start;
  std::array<Cell, 4> end;
  for (int i = 0; i < 4; ++i) {
    const auto height = [&] {
      const std::int64_t more = chance(60) ? 0 : pick(0, deep);
      return i < firsts ? width + more : -more;
    };
    const auto across = [&] {
      return flat ? Cell(pick(-shape, shape) * f.first) : inPlane(f, shape);
    };
    start[i] = height() * f.normal + across();
    end[i] = still ? start[i] : Cell(height() * f.normal + across());
    const int o = i < firsts ? 0 : firsts;
    if (point && i != o) {
      start[i] = start[o];
      end[i] = end[o];
    }
  }
  return finish(edges, start, end, separation * f.length, tolerance * f.length);
}

}  // namespace swept::test
