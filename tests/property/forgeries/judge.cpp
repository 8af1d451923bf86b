// SPDX-License-Identifier: BSD-3-Clause
#include "judge.hpp"

#include <algorithm>

#include "errors.hpp"

namespace forgeries {
namespace {

/// Sets of errors at each time.
constexpr int kErrors = 4;

struct Plane {
  Vec direction;
  Real length, bound;
};

void planesIn(const Json& tree, std::vector<Plane>& planes) {
  if (tree.is_array()) {
    const Vec direction = vecOf(tree);
    planes.push_back({direction, direction.norm(), Real(tree[3].get<double>())});
    return;
  }
  for (const Json& halves : tree)
    for (const Json& half : halves) planesIn(half, planes);
}

Real support(const Solid& solid, const Pose& pose, const Vec& direction) {
  return direction.dot(pose.translation) + solid.support(pose.back(direction));
}

/// Two bodies on a segment.
class Pair {
 public:
  Pair(const Json& path, std::size_t segment, const std::string& a, const std::string& b)
      : path_(path), motion_(path, segment), keep_(path["model"]["margin"].get<double>()) {
    const Json& model = path["model"];
    for (const Json& body : model["bodies"]) {
      const std::string name = body["name"];
      if (name != a && name != b) continue;
      (name == a ? a_ : b_) = bodyOf(body);
      if (model["paddings"].contains(name)) keep_ += Real(model["paddings"][name].get<double>());
    }
    if (!b_.link.empty()) reference_ = motion_.commonAncestor(a_.link, b_.link);
  }

  const ExactBody& a() const { return a_; }
  const ExactBody& b() const { return b_; }
  const Real& keep() const { return keep_; }
  Pose poseOf(const ExactBody& body, double t, const Errors& errors) const {
    return motion_.placed(body.link, reference_, Real(t), errors);
  }
  Errors errorsAt(double t, Random& random) const {
    return drawErrors(path_, motion_, Real(t), random);
  }
  bool inTube() const { return path_["model"].contains("tracking"); }
  /// Of all of a, at its pose.
  Real fromWall(std::size_t wall, int side, const Pose& poseA) const {
    const Vec away = b_.walls[wall].normal * Real(-side);
    Real most = support(a_.solids.front(), poseA, away);
    for (const Solid& solid : a_.solids) most = std::max(most, support(solid, poseA, away));
    return (-side * b_.walls[wall].offset - most) / away.norm();
  }

 private:
  const Json& path_;
  ExactMotion motion_;
  ExactBody a_, b_;
  std::string reference_;
  Real keep_;
};

Real apart(const Solid& a, const Pose& poseA, const Solid& b, const Pose& poseB,
           const Plane& plane) {
  return (-support(b, poseB, plane.direction * Real(-1)) - support(a, poseA, plane.direction)) /
         plane.length;
}

/// The proof of a pair in one segment.
class PairJudge {
 public:
  PairJudge(const Json& path, std::size_t segment, const Json& proof, Random& random)
      : pair_(path, segment, proof["a"], proof["b"]),
        proof_(proof),
        random_(random),
        first_(segment == 0) {}

  std::string judge() {
    std::string found;
    if (!pair_.b().solids.empty()) found = uncovered(proof_["intervals"]);
    for (std::size_t i = 0; i < pair_.b().walls.size(); ++i)
      if (found.empty()) found = uncovered(proof_["flats"][i]);
    if (!pair_.b().solids.empty())
      for (const Json& interval : proof_["intervals"])
        if (found.empty()) found = between(interval);
    for (std::size_t i = 0; i < pair_.b().walls.size(); ++i)
      for (const Json& interval : proof_["flats"][i])
        if (found.empty()) found = beside(i, interval);
    if (found.empty() && first_ && !pair_.b().solids.empty()) found = enclosed();
    if (found.empty()) return "";
    return proof_["a"].get<std::string>() + " - " + proof_["b"].get<std::string>() + ", " + found;
  }

 private:
  /// The whole segment has to be spoken of.
  static std::string uncovered(const Json& intervals) {
    double end = 0.0;
    for (const Json& interval : intervals) {
      if (interval[0].get<double>() != end) return "a gap at " + std::to_string(end);
      end = interval[1];
    }
    return end == 1.0 ? "" : "nothing from " + std::to_string(end);
  }
  /// A time, and what joints are off at it.
  struct Instant {
    double t;
    Errors errors;
  };
  std::vector<Instant> instantsOf(const Json& interval) {
    const double begin = interval[0], end = interval[1];
    std::vector<Instant> instants;
    for (const double t : {begin, end, 0.5 * (begin + end), random_.uniform(begin, end)}) {
      instants.push_back({t, {}});
      for (int i = 0; pair_.inTube() && i < kErrors; ++i)
        instants.push_back({t, pair_.errorsAt(t, random_)});
    }
    return instants;
  }
  static std::string text(double t, const Real& truth, const Real& bound) {
    return "at " + Real(t).str(20) + " only " + truth.str(20) + " m, not " + bound.str(20) + " m";
  }

  std::string between(const Json& interval) {
    std::vector<Plane> planes;
    planesIn(interval[2], planes);
    for (const Plane& plane : planes)
      if (plane.bound < pair_.keep()) return "a bound below the margin";
    for (const auto& [t, errors] : instantsOf(interval)) {
      const Pose poseA = pair_.poseOf(pair_.a(), t, errors);
      const Pose poseB = pair_.poseOf(pair_.b(), t, errors);
      for (const Solid& a : pair_.a().solids)
        for (const Solid& b : pair_.b().solids) {
          std::string found = "no plane";
          for (const Plane& plane : planes) {
            if (found.empty()) break;
            const Real truth = apart(a, poseA, b, poseB, plane);
            found = truth >= plane.bound ? "" : text(t, truth, plane.bound);
          }
          if (!found.empty()) return found;
        }
    }
    return "";
  }

  std::string beside(std::size_t wall, const Json& interval) {
    const int side = interval[2][0];
    const Real bound(interval[2][1].get<double>());
    if (bound < pair_.keep()) return "a bound below the margin";
    if (side < 0 && pair_.b().walls[wall].isSolid) return "inside of a half-space";
    for (const auto& [t, errors] : instantsOf(interval)) {
      const Real truth = pair_.fromWall(wall, side, pair_.poseOf(pair_.a(), t, errors));
      if (truth < bound) return text(t, truth, bound);
    }
    return "";
  }

  std::string enclosed() const {
    if (proof_["intervals"][0][2].is_array()) return "";
    const Pose poseA = pair_.poseOf(pair_.a(), 0.0, {}), poseB = pair_.poseOf(pair_.b(), 0.0, {});
    const bool found = encloses(pair_.a(), poseA, pair_.b(), poseB) ||
                       encloses(pair_.b(), poseB, pair_.a(), poseA);
    return found ? "one is inside the other at the beginning" : "";
  }

  static bool encloses(const ExactBody& outer, const Pose& poseOuter, const ExactBody& inner,
                       const Pose& poseInner) {
    for (Shell shell : outer.shells) {
      for (std::array<Vec, 3>& triangle : shell)
        for (Vec& corner : triangle) corner = poseOuter * corner;
      for (const Solid& solid : inner.solids) {
        const Vec own = solid.points.empty() ? Vec{0, 0, 0} : solid.points.front();
        if (isInside(shell, poseInner * (solid.frame * own))) return true;
      }
    }
    return false;
  }

  Pair pair_;
  const Json& proof_;
  Random& random_;
  bool first_;
};

}  // namespace

std::string refutation(const Json& path, Random& random) {
  const Json& segments = path["proof"]["segments"];
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (const Json& pair : segments[i]["pairs"]) {
      const std::string found = PairJudge(path, i, pair, random).judge();
      if (!found.empty()) return "segment " + std::to_string(i + 1) + ", " + found;
    }
  return "";
}

Real separation(const Json& path, std::size_t segment, const std::string& a, const std::string& b,
                const Json& direction, double t, Random* errors) {
  const Pair pair(path, segment, a, b);
  const Errors off = errors == nullptr ? Errors{} : pair.errorsAt(t, *errors);
  const Vec way = vecOf(direction);
  const Plane plane{way, way.norm(), 0};
  const Pose poseA = pair.poseOf(pair.a(), t, off), poseB = pair.poseOf(pair.b(), t, off);
  Real least = apart(pair.a().solids.front(), poseA, pair.b().solids.front(), poseB, plane);
  for (const Solid& own : pair.a().solids)
    for (const Solid& other : pair.b().solids)
      least = std::min(least, apart(own, poseA, other, poseB, plane));
  return least;
}

Real wallSeparation(const Json& path, std::size_t segment, const std::string& a,
                    const std::string& b, std::size_t wall, int side, double t, Random* errors) {
  const Pair pair(path, segment, a, b);
  const Errors off = errors == nullptr ? Errors{} : pair.errorsAt(t, *errors);
  return pair.fromWall(wall, side, pair.poseOf(pair.a(), t, off));
}

}  // namespace forgeries
