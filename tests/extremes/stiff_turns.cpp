// SPDX-License-Identifier: BSD-3-Clause
#include <boost/math/constants/constants.hpp>
#include <numbers>

#include "stiff_sample.hpp"

namespace extremes {

namespace {

Real pi() {
  return boost::math::constants::pi<Real>();
}

/// A ball on a lever that turns about z, beside a post as high as it gets, and slides up, to a
/// ceiling.
struct Turn {
  double lever = 1.0, ball = 0.1;      ///< m
  double post = 0.1;                   ///< m, radius
  Vector3d at = Vector3d(1.5, 0, 0);   ///< m, the middle of the post
  double from = 0.0, to = 1.0;         ///< rad
  double up = 0.0;                     ///< m, of the slide, from 0
  std::optional<double> ceiling = {};  ///< m
  bool continuous = false;             ///< the shorter way
  double tolerance = 1e-4;             ///< m
  double accuracy = 0.0;               ///< m; 0: 10 tolerances
};

class TurnTruth {
 public:
  explicit TurnTruth(const Turn& turn)
      : turn_(turn),
        away_(sqrt(Real(turn.at.x()) * turn.at.x() + Real(turn.at.y()) * turn.at.y())),
        towards_(atan2(Real(turn.at.y()), Real(turn.at.x()))),
        radii_(Real(turn.ball) + turn.post),
        way_(Real(turn.to) - turn.from) {
    if (!turn.continuous) return;
    while (way_ > pi()) way_ -= 2 * pi();
    while (way_ < -pi()) way_ += 2 * pi();
  }

  Real way() const { return way_; }

  Real distance(const Real& t) const {
    const Real d = toPost(t);
    return turn_.ceiling ? std::min(d, toCeiling(t)) : d;
  }

  std::optional<Real> contact() const {
    std::optional<Real> first = postContact();
    if (turn_.ceiling) {
      const Real gap = toCeiling(0);
      const bool meets = gap <= 0 || gap <= turn_.up;
      if (meets) {
        const Real t = gap <= 0 ? Real(0) : Real(gap / turn_.up);
        first = first ? std::min(*first, t) : t;
      }
    }
    return first;
  }

  Real least() const {
    Real least = std::min(distance(0), distance(1));
    if (entry(0)) least = std::min(least, Real(abs(away_ - turn_.lever) - radii_));
    return least;
  }

 private:
  Real toPost(const Real& t) const {
    const Real angle = Real(turn_.from) + t * way_ - towards_;
    const Real l = turn_.lever;
    // Squares of half angles lose no digits close by.
    const Real s = sin(angle / 2);
    return sqrt((away_ - l) * (away_ - l) + 4 * l * away_ * s * s) - radii_;
  }
  Real toCeiling(const Real& t) const {
    return Real(*turn_.ceiling) - turn_.ball - t * Real(turn_.up);
  }

  /// The first t at which the lever is within `half` (rad) of the post.
  std::optional<Real> entry(const Real& half) const {
    // Seen as a turn that increases, towards 0.
    const Real sign = way_ < 0 ? -1 : 1;
    const Real start = sign * (Real(turn_.from) - towards_);
    const Real turns = ceil((start - half) / (2 * pi()));
    const Real entered = std::max(start, Real(turns * 2 * pi() - half));
    const Real length = abs(way_);
    if (entered > start + length) return std::nullopt;
    return length > 0 ? Real((entered - start) / length) : Real(0);
  }

  std::optional<Real> postContact() const {
    const Real l = turn_.lever;
    const Real square = (radii_ * radii_ - (away_ - l) * (away_ - l)) / (4 * l * away_);
    if (square < 0) return std::nullopt;
    return entry(square >= 1 ? pi() : Real(2 * asin(sqrt(square))));
  }

  Turn turn_;
  Real away_, towards_, radii_, way_;
};

std::optional<Spin> spinOf(const Turn& turn) {
  if (turn.from != 0.0 || turn.continuous) return std::nullopt;
  Turn alone = turn;
  alone.ceiling.reset();
  const TurnTruth truth(alone);
  return Spin{turn.lever,
              turn.ball,
              swept::Cylinder{turn.post, 100.0},
              Isometry3d(Eigen::Translation3d(turn.at)),
              turn.to,
              turn.up,
              turn.tolerance,
              truth.contact(),
              truth.least(),
              [truth](const Real& t) { return truth.distance(t); }};
}

StiffSample sampleOf(const Turn& turn) {
  const TurnTruth truth(turn);
  StiffSample sample;
  const auto robot = chainWithBall({{"prismatic"}, {turn.continuous ? "continuous" : "revolute"}},
                                   {turn.lever, 0, 0}, turn.ball);
  swept::World world;
  world.add("post", swept::Cylinder{turn.post, 100.0}, Isometry3d(Eigen::Translation3d(turn.at)));
  if (turn.ceiling) {
    world.add("ceiling", swept::HalfSpace{-Vector3d::UnitZ(), -*turn.ceiling},
              Isometry3d::Identity());
  }
  sample.checker = checkerOf(robot, std::move(world), turn.tolerance);
  sample.from = {0.0, turn.from};
  sample.to = {turn.up, turn.to};
  sample.distance = [truth](const Real& t) { return truth.distance(t); };
  sample.contact = truth.contact();
  sample.least = truth.least();
  sample.reach = turn.lever + turn.ball;
  sample.accuracy = turn.accuracy;
  sample.spin = spinOf(turn);
  sample.path = std::hypot(turn.lever * truth.way().convert_to<double>(), turn.up);
  return sample;
}

Vector3d polar(double away, double angle) {
  return {away * std::cos(angle), away * std::sin(angle), 0.0};
}

Turn drawTurn(Random& random) {
  Turn turn;
  turn.lever = random.uniform(0.5, 1.5);
  turn.ball = random.uniform(0.02, 0.1);
  turn.post = random.uniform(0.02, 0.1);
  turn.from = random.chance(0.5) ? 0.0 : random.uniform(-2.0, 2.0);
  turn.to = turn.from + random.sign() * random.uniform(1.0, 3.0);
  return turn;
}

/// The post beside the way of the ball with this gap, outside or inside, between the ends.
void placePost(Turn& turn, double gap, Random& random) {
  const double aside = (turn.ball + turn.post + gap) * random.sign();
  const double share = random.uniform(0.3, 0.7);
  turn.at = polar(turn.lever + aside, turn.from + share * (turn.to - turn.from));
}

double gapOf(Random& random, int i, double low, double high) {
  const double gap = random.decades(low, high);
  return i % 2 == 0 ? gap : -0.5 * gap;
}

Turn ordinaryTurn(Random& random, int i) {
  Turn turn = drawTurn(random);
  placePost(turn, gapOf(random, i, -2.0, -1.3), random);
  return turn;
}

/// Slides by a share of the angle that it turns by; half of the hits are with the ceiling.
Turn fast(Random& random, int i, double turns, double up) {
  Turn turn = drawTurn(random);
  if (turns > 0.0) turn.to = turn.from + random.sign() * 2.0 * std::numbers::pi * turns;
  turn.up = up;
  const bool hits = i % 2 == 1;
  const bool atCeiling = hits && i % 4 == 1;
  placePost(turn, hits && !atCeiling ? -0.02 : random.uniform(0.01, 0.05), random);
  const double share = atCeiling ? random.uniform(0.1, 0.9) : random.uniform(1.5, 3.0);
  turn.ceiling = turn.ball + share * up;
  if (!atCeiling) turn.ceiling = *turn.ceiling + 0.01;
  // What is asked for has to be less than the way that is left behind the ceiling.
  turn.tolerance = std::min(1e-4, 0.01 * up);
  turn.accuracy = 1e-3;
  return turn;
}

Turn lever(Random& random, int i) {
  Turn turn = drawTurn(random);
  turn.lever = 1.0;
  turn.tolerance = 1e-7;
  placePost(turn, i % 2 == 0 ? 1e-6 : -1e-6, random);
  return turn;
}

Turn grazing(Random& random, int i) {
  Turn turn = drawTurn(random);
  turn.tolerance = 1e-7;
  placePost(turn, gapOf(random, i, -9.0, -3.0), random);
  return turn;
}

/// From where it is: just apart, or just touching.
Turn still(Random& random, int i, double way) {
  Turn turn = drawTurn(random);
  placePost(turn, gapOf(random, i, -6.0, -2.0), random);
  turn.tolerance = 1e-7;
  turn.from = std::atan2(turn.at.y(), turn.at.x());
  turn.to = turn.from + way;
  return turn;
}

/// Ends, or starts, where the ball meets the post; `share` of the way to there is left.
Turn meeting(Random& random, int i, double share) {
  Turn turn = drawTurn(random);
  turn.tolerance = 1e-6;
  placePost(turn, -0.01, random);
  const double first = TurnTruth(turn).contact()->convert_to<double>();
  const double way = turn.to - turn.from;
  const double met = turn.from + first * way;
  // Half of them do not get there, or come from there.
  const double off = i % 2 == 0 ? -0.1 : 0.0;
  if (share == 0.0) {
    turn.from = met + (i % 2 == 0 ? -1e-3 : 1e-12) * way;
    turn.to = i % 2 == 0 ? turn.from - way : turn.from + way;
  } else {
    turn.to = turn.from + (met - turn.from) / (share - off);
  }
  return turn;
}

/// Across +-pi, where the numbers jump: the post is there, or on the other side.
Turn wrapping(Random& random, int i) {
  Turn turn = drawTurn(random);
  turn.continuous = true;
  const double sign = random.sign();
  turn.from = sign * (std::numbers::pi - random.decades(-9.0, 0.0));
  turn.to = -sign * (std::numbers::pi - random.uniform(0.5, 1.0));
  const double away = turn.lever + (i % 2 == 0 ? 0.0 : -0.01);
  turn.at = polar(away, i % 2 == 0 ? random.uniform(-1.0, 1.0) : -sign * (std::numbers::pi - 0.3));
  return turn;
}

StiffCase turnCase(const std::string& name, double workLimit,
                   const std::function<Turn(Random&, int)>& draw, bool bothSides = true,
                   double clearanceLimit = 0.0) {
  return {name,      "ordinary turn",
          workLimit, [draw](Random& random, int i) { return sampleOf(draw(random, i)); },
          bothSides, clearanceLimit};
}

}  // namespace

std::vector<StiffCase> turnCases() {
  const auto ratio = [](double turns, double up) {
    return [=](Random& random, int i) { return fast(random, i, turns, up); };
  };
  const auto way = [](double rad) {
    return [=](Random& random, int i) { return still(random, i, rad); };
  };
  const auto meets = [](double share) {
    return [=](Random& random, int i) { return meeting(random, i, share); };
  };
  return {turnCase("ordinary turn", 1.0, ordinaryTurn),
          turnCase("one joint 1 000 times as fast", 10.0, ratio(0.0, 2e-3)),
          turnCase("joint speeds 1 : 1e6", 200.0, ratio(0.0, 2e-6)),
          turnCase("1 000 turns", 2500.0, ratio(1000.0, 0.1)),
          turnCase("1 m lever, gap 1e-6 m", 10.0, lever, true, 20.0),
          turnCase("grazing by 1e-9 to 1e-3 m", 10.0, grazing, true, 20.0),
          turnCase("motion of length 0", 2.0, way(0.0)),
          turnCase("motion of 1e-12 rad", 2.0, way(1e-12)),
          turnCase("first contact at t = 0", 4.0, meets(0.0)),
          turnCase("first contact at t = 1", 10.0, meets(1.0), false),
          turnCase("first contact at t = 1 - 1e-12", 10.0, meets(1.0 - 1e-12), false),
          turnCase("the shorter way across +-pi", 10.0, wrapping)};
}

}  // namespace extremes
