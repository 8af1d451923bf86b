// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_clearances.hpp"

#include <algorithm>
#include <limits>

#include "page/packed.hpp"
#include "swept/core/distance.hpp"

namespace swept {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// m. Finer than what a page shows.
constexpr double kAccuracy = 2e-5;
/// Pairs of bodies over all frames; a page takes seconds, not minutes.
constexpr std::size_t kMostPairs = 100'000;

/// Two bodies and a first lower bound of their distance (m).
struct Pair {
  std::size_t a, b;
  bool self = false;  ///< of two bodies of the robot
  double bound = 0.0;
};

/// A body of the world may have the name of a link.
std::size_t indexOf(const std::vector<PageBody>& bodies, const std::string& name, bool ofRobot) {
  const auto found = std::ranges::find_if(bodies, [&](const PageBody& body) {
    return body.name == name && (body.kind != PageBody::Kind::World) == ofRobot;
  });
  return static_cast<std::size_t>(found - bodies.begin());
}

/// The part's shape and where it is, with the ball around it.
struct Placed {
  const Shape* shape;
  Eigen::Isometry3d model_from_shape;
  BoundingSphere ball;  ///< model frame
};

std::vector<Placed> placedParts(const PageBody& body, const PageFrames& frames, std::size_t frame) {
  std::vector<Placed> placed;
  for (const PageBody::Part& part : body.parts) {
    Eigen::Isometry3d pose = part.body_from_shape;
    if (body.link >= 0) pose = frames.pose(frame, body.link) * pose;
    if (body.moving != nullptr) pose = body.moving->poseAt(frames.clocks[frame]) * pose;
    BoundingSphere ball = boundingSphere(part.shape);
    ball.center = pose * ball.center;
    placed.push_back({&part.shape, pose, ball});
  }
  return placed;
}

/// The radius is 0 for planes and half-spaces, which no ball contains.
double gapOf(const BoundingSphere& a, const BoundingSphere& b) {
  const double gap = (a.center - b.center).norm() - a.radius - b.radius;
  return gap > 0.0 ? gap : 0.0;
}

double gapOf(const std::vector<Placed>& a, const std::vector<Placed>& b) {
  double least = kInfinity;
  for (const Placed& first : a)
    for (const Placed& second : b) least = std::min(least, gapOf(first.ball, second.ball));
  return least;
}

/// A lower bound of the distance (m). It is the distance itself, to the accuracy, where that is
/// below `enough`.
double distanceOf(const std::vector<Placed>& a, const std::vector<Placed>& b, double enough) {
  double least = kInfinity;
  for (const Placed& first : a)
    for (const Placed& second : b) {
      const double limit = std::min(least, enough);
      if (gapOf(first.ball, second.ball) >= limit) continue;
      const DistanceOptions options{.enough = limit, .tolerance = kAccuracy};
      const Eigen::Isometry3d a_from_b =
          first.model_from_shape.inverse(Eigen::Isometry) * second.model_from_shape;
      least = std::min(least, distance(*first.shape, *second.shape, a_from_b, options).lower);
    }
  return least;
}

/// One frame's nearest partners.
class Nearest {
 public:
  explicit Nearest(std::size_t bodies) : distance_(bodies, kInfinity), partner_(bodies, -1) {}

  /// The distance beyond which the pair matters to neither of its bodies.
  double enough(const Pair& pair) const { return std::max(distance_[pair.a], distance_[pair.b]); }
  void offer(const Pair& pair, double metres) {
    offer(pair.a, pair.b, metres);
    offer(pair.b, pair.a, metres);
  }
  void appendTo(PageClearances::Table& table) const {
    for (const double metres : distance_) table.distance.push_back(roundedDown(metres));
    table.partner.insert(table.partner.end(), partner_.begin(), partner_.end());
  }

 private:
  void offer(std::size_t body, std::size_t other, double metres) {
    if (!(metres < distance_[body])) return;
    distance_[body] = metres;
    partner_[body] = static_cast<std::int32_t>(other);
  }
  std::vector<double> distance_;
  std::vector<std::int32_t> partner_;
};

void appendFrame(const std::vector<PageBody>& bodies, const PageFrames& frames, std::size_t frame,
                 std::vector<Pair> pairs, PageClearances& table) {
  std::vector<std::vector<Placed>> placed;
  for (const PageBody& body : bodies) placed.push_back(placedParts(body, frames, frame));
  for (Pair& pair : pairs) pair.bound = gapOf(placed[pair.a], placed[pair.b]);
  // The nearest first: most others then need no distance.
  std::ranges::sort(pairs, {}, &Pair::bound);
  Nearest world(bodies.size()), self(bodies.size());
  for (const Pair& pair : pairs) {
    Nearest& nearest = pair.self ? self : world;
    const double enough = nearest.enough(pair);
    if (pair.bound < enough)
      nearest.offer(pair, distanceOf(placed[pair.a], placed[pair.b], enough));
  }
  world.appendTo(table.world);
  self.appendTo(table.self);
}

Json tableJson(const PageClearances::Table& table) {
  return {{"distance", packed<float>(table.distance)},
          {"partner", packed<std::int32_t>(table.partner)}};
}

}  // namespace

PageClearances clearancesOf(const Checker& checker, const std::vector<PageBody>& bodies,
                            const PageFrames& frames) {
  std::vector<Pair> pairs;
  for (const Checker::Pair& pair : checker.checkedPairs()) {
    const std::size_t a = indexOf(bodies, pair.bodyA, true);
    const std::size_t b = indexOf(bodies, pair.bodyB, pair.selfPair);
    if (a < bodies.size() && b < bodies.size())
      pairs.push_back({.a = a, .b = b, .self = pair.selfPair});
  }
  PageClearances table{.stride = 1, .bodies = bodies.size(), .world = {}, .self = {}};
  const std::size_t work = pairs.size() * frames.poses.size();
  table.stride = static_cast<int>(1 + work / (kMostPairs + 1));
  for (std::size_t frame = 0; frame < frames.poses.size();
       frame += static_cast<std::size_t>(table.stride))
    appendFrame(bodies, frames, frame, pairs, table);
  return table;
}

PageClearances::Table PageClearances::nearer() const {
  Table table = world;
  for (std::size_t i = 0; i < table.distance.size(); ++i) {
    if (!(self.distance[i] < table.distance[i])) continue;
    table.distance[i] = self.distance[i];
    table.partner[i] = self.partner[i];
  }
  return table;
}

Json PageClearances::json() const {
  Json json = {{"stride", stride}, {"bodies", bodies}};
  json.update(tableJson(nearer()));
  json["world"] = tableJson(world);
  json["self"] = tableJson(self);
  return json;
}

}  // namespace swept
