// SPDX-License-Identifier: BSD-3-Clause
#include "check.hpp"

#include <algorithm>

#include "constraint.hpp"
#include "enclosed.hpp"
#include "encoding.hpp"
#include "environment.hpp"
#include "line.hpp"
#include "motion.hpp"
#include "proof.hpp"
#include "trajectory.hpp"

namespace swept::verify {
namespace {

void compareDigests(const Json& claimed, const Json& actual, const std::string& kind) {
  if (!claimed.is_object()) throw Refusal("proof, digests: there are none of " + kind);
  for (const auto& [name, digest] : actual.items()) {
    if (!claimed.contains(name))
      throw Refusal(kind + " " + name + ": was not there when the path was certified");
    if (claimed[name] != digest) throw Refusal(kind + " " + name + kChanged);
  }
  for (const auto& [name, digest] : claimed.items())
    if (!actual.contains(name))
      throw Refusal(kind + " " + name + ": is not there, and was when the path was certified");
}

std::vector<double> readState(const Json& json, const Model& model, const std::string& where) {
  if (!json.is_array() || json.size() != model.variables.size())
    throw Refusal(where + ": not one value for each of " + std::to_string(model.variables.size()) +
                  " variables");
  std::vector<double> q;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const Variable& variable = model.variables[i];
    q.push_back(readNumber(json[i], where + ", " + variable.name));
    if (!(q[i] >= variable.lower - kLimit && q[i] <= variable.upper + kLimit))
      throw Refusal(where + ", " + variable.name + ": beyond its limits");
  }
  return q;
}

class ProofCheck {
 public:
  ProofCheck(const Json& path, const Json& modelJson, const Pause& pause)
      : path_(path), proof_(at(path, "proof", "path")), pause_(pause) {
    requireSameModel(proof_, modelJson);
    model_ = readModel(modelJson);
    requireSameClaims();
    readClock();
    if (path.contains("trajectory"))
      readTrajectory();
    else
      readStates();
    pairs_ = pairsToProve(model_);
    if (path.contains("constraints")) constraints_ = readConstraints(path["constraints"], model_);
    if (path.contains("lines")) addLines(path["lines"]);
  }

  Summary run() {
    const Json& segments = readList(proof_, "segments", "proof");
    if (segments.size() + 1 != knots().size())
      throw Refusal("proof, segments: " + std::to_string(segments.size()) + ", and " +
                    std::to_string(knots().size()) + " " + knotName() + "s");
    // Changed states first: otherwise the message would name consequences of them.
    for (std::size_t i = 0; i < segments.size(); ++i) requireKnots(segments, i);
    for (std::size_t i = 0; i < segments.size(); ++i) checkSegment(segments[i], i);
    addDescription();
    summary_.segments = segments.size();
    return summary_;
  }

 private:
  /// The file's claims besides states and proof: users of the robot rely on them.
  void requireSameClaims() const {
    compareDigests(at(at(proof_, "digests", "proof"), "claims", "digests"), claimDigests(path_),
                   "path file,");
    const Json& names = readList(path_, "joint_names", "path");
    for (std::size_t i = 0; i < std::max(names.size(), model_.variables.size()); ++i)
      if (i >= names.size() || i >= model_.variables.size() || names[i] != model_.variables[i].name)
        throw Refusal("joint_names: they are not the variables of the group, in its order");
    if (at(path_, "margin", "path") != model_.margin)
      throw Refusal("margin: it is not that of the model");
    for (const auto& [key, margin] :
         {std::pair{"margin_self", model_.selfMargin}, {"margin_world", model_.worldMargin}})
      if ((path_.contains(key) ? path_[key] : path_["margin"]) != margin)
        throw Refusal(std::string(key) + ": it is not that of the model");
  }

  /// Times of a trajectory are those of the clock, less what it shows at the time 0.
  void readClock() {
    if (model_.obstacles.empty()) {
      if (path_.contains("clock")) throw Refusal("clock: nothing moves but the robot");
      return;
    }
    const std::string& name = model_.bodies[model_.obstacles.begin()->first].name();
    if (!path_.contains("trajectory"))
      throw Refusal("body " + name + ": it moves, and a path without times does not say when");
    model_.clock = readNumber(at(path_, "clock", "path"), "clock");
  }

  void readStates() {
    if (at(proof_, "digests", "proof").contains("points"))
      throw Refusal("trajectory: is not there, and was when the path was certified");
    const Json& states = readList(path_, "states", "path");
    for (std::size_t i = 0; i < states.size(); ++i)
      states_.push_back(readState(states[i], model_, "state " + std::to_string(i + 1)));
    if (states_.size() < 2) throw Refusal("states: fewer than two");
  }

  /// Whoever reads only the states has the points' positions.
  void readTrajectory() {
    const Json& trajectory = path_["trajectory"];
    const Json& digests = at(proof_, "digests", "proof");
    if (!digests.contains("points"))
      throw Refusal("trajectory: was not there when the path was certified");
    requireSamePoints(digests["points"], trajectory, model_);
    points_ = readPoints(trajectory, model_);
    const Json& states = readList(path_, "states", "path");
    if (states.size() != points_.size())
      throw Refusal("states: " + std::to_string(states.size()) + ", and " +
                    std::to_string(points_.size()) + " points");
    for (std::size_t i = 0; i < states.size(); ++i)
      if (states[i] != knots()[i]["positions"])
        throw Refusal("state " + std::to_string(i + 1) + ": it is not the positions of point " +
                      std::to_string(i + 1));
  }

  void addLines(const Json& lines) {
    if (!points_.empty())
      throw Refusal("lines: they are of straight motions between states, and this is a trajectory");
    lines_ = readLines(lines, model_, states_.size() - 1);
    if (!lines_.empty()) still_ = withoutTolerances(model_);
  }

  /// What each two of are a segment.
  const Json& knots() const {
    return points_.empty() ? path_["states"] : path_["trajectory"]["points"];
  }
  std::string knotName() const { return points_.empty() ? "state" : "point"; }

  Motion motionOf(std::size_t segment) const {
    return points_.empty() ? Motion(model_, states_[segment], states_[segment + 1])
                           : Motion(model_, points_[segment], points_[segment + 1]);
  }

  void addDescription() {
    summary_.pairs = pairs_.size();
    for (const auto& [pair, reason] : model_.allowed)
      summary_.allowed[reason].push_back(nameOf({pair.first, pair.second}));
    if (!points_.empty()) summary_.duration = points_.back().time - points_.front().time;
    addTube();
    addMoving();
    for (const Constraint& constraint : constraints_)
      summary_.constraints.push_back(constraint.text);
    for (const Line& line : lines_) summary_.constraints.push_back(line.text);
  }

  void addMoving() {
    for (const auto& [body, obstacle] : model_.obstacles)
      summary_.moving.push_back(model_.bodies[static_cast<std::size_t>(body)].name());
    if (summary_.moving.empty()) return;
    summary_.clockBegin = model_.clock + points_.front().time;
    summary_.clockEnd = model_.clock + points_.back().time;
  }

  /// Joints that follow others are off as far as these let them.
  void addTube() {
    bool tight = true;
    for (const Joint& joint : model_.joints) {
      if (joint.variable < 0 || valuesOf(joint.kind) == 0 || joint.multiplier != 1.0) continue;
      JointTube& own = summary_.tube[joint.name];
      if (joint.kind != JointKind::Prismatic) own.rotation = joint.tolerance.rotation;
      if (joint.kind != JointKind::Revolute) own.translation = joint.tolerance.translation;
      tight = tight && joint.tolerance.rotation == 0.0 && joint.tolerance.translation == 0.0;
    }
    if (tight) summary_.tube.clear();
  }

  std::string nameOf(PairToProve pair) const {
    return model_.bodies[static_cast<std::size_t>(pair.a)].name() + " - " +
           model_.bodies[static_cast<std::size_t>(pair.b)].name();
  }

  bool knotsFit(const Json& segments, std::size_t i) const {
    return at(segments[i], "states_digest", "segment " + std::to_string(i + 1)) ==
           stateDigest(knots()[i], knots()[i + 1]);
  }

  /// Names the state or point that two segments share, if neither matches.
  void requireKnots(const Json& segments, std::size_t i) const {
    if (knotsFit(segments, i)) return;
    const bool next = i + 1 < segments.size() && !knotsFit(segments, i + 1);
    const std::size_t knot = next || i + 1 == segments.size() ? i + 2 : i + 1;
    throw Refusal(knotName() + " " + std::to_string(knot) + kChanged);
  }

  void checkSegment(const Json& segment, std::size_t i) {
    const std::string where = "segment " + std::to_string(i + 1);
    const Motion motion = motionOf(i);
    const Json& proofs = readList(segment, "pairs", where);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      if (pause_) pause_();
      const std::string place = where + ", " + nameOf(pairs_[k]);
      const Body& a = model_.bodies[static_cast<std::size_t>(pairs_[k].a)];
      const Body& b = model_.bodies[static_cast<std::size_t>(pairs_[k].b)];
      if (k >= proofs.size() || at(proofs[k], "a", place) != a.name() ||
          at(proofs[k], "b", place) != b.name())
        throw Refusal(place + ": there is no proof of this pair in its place");
      // A failed proof of a pair is named more exactly than a changed one.
      summary_.add(checkPair(model_, motion, pairs_[k], proofs[k], place));
      if (at(proofs[k], "digest", place) != pairDigest(proofs[k])) throw Refusal(place + kChanged);
      if (i == 0) requireNotEnclosed(model_, motion, pairs_[k], proofs[k], place);
    }
    if (proofs.size() != pairs_.size())
      throw Refusal(where + ": it has proofs of pairs that are not checked");
    for (const Constraint& constraint : constraints_)
      summary_.intervals +=
          checkConstraint(model_, motion, constraint, where + ", " + constraint.name);
    for (const Line& line : lines_)
      if (line.has(i))
        summary_.intervals += checkLine(Motion(still_, states_[i], states_[i + 1]), line, i,
                                        where + ", " + line.name);
  }

  const Json& path_;
  const Json& proof_;
  const Pause& pause_;
  Model model_;
  std::vector<std::vector<double>> states_;  ///< of a path that is no trajectory
  std::vector<Point> points_;                ///< of a trajectory
  std::vector<PairToProve> pairs_;
  std::vector<Constraint> constraints_;
  std::vector<Line> lines_;
  Model still_;  ///< without tolerances, for lines
  Summary summary_;
};

}  // namespace

void requireSameModel(const Json& proof, const Json& model) {
  const Json& claimed = at(proof, "digests", "proof");
  const Json actual = digestsOf(model);
  compareDigests(at(claimed, "joints", "digests"), actual["joints"], "joint");
  compareDigests(at(claimed, "bodies", "digests"), actual["bodies"], "body");
  if (at(claimed, "rules", "digests") != actual["rules"])
    throw Refusal(
        "rules: the group, its limits, margins, tolerances or pairs that may touch are not as they "
        "were when the path was certified");
}

Json digestsOf(const Json& model) {
  Json digests = {{"joints", Json::object()}, {"bodies", Json::object()}};
  Json rules = model;
  for (const char* kind : {"joints", "bodies"}) {
    for (const Json& item : readList(model, kind, "model")) {
      const Json& name = at(item, "name", kind);
      if (!name.is_string()) throw Refusal(std::string(kind) + ": a name is not a text");
      Json& digest = digests[kind][name.get<std::string>()];
      // Of two with the same name, the second one's digest would stand for both.
      if (!digest.is_null())
        throw Refusal(std::string(kind) + ": there are two of the name " + name.dump());
      digest = digestOf(item.dump());
    }
    rules.erase(kind);
  }
  digests["rules"] = digestOf(rules.dump());
  return digests;
}

Json claimDigests(const Json& path) {
  Json digests = Json::object();
  for (const auto& [key, value] : path.items())
    if (key != "states" && key != "trajectory" && key != "proof" && key != "model" &&
        key != "inputs")
      digests[key] = digestOf(value.dump());
  return digests;
}

std::string stateDigest(const Json& from, const Json& to) {
  return digestOf(from.dump() + to.dump());
}

std::string pairDigest(Json pair) {
  pair.erase("digest");
  return digestOf(pair.dump()).substr(0, 16);
}

Summary checkProof(const Json& path, const Json& model, const Pause& pause) {
  Summary summary;
  inDefaultEnvironment([&] { summary = ProofCheck(path, model, pause).run(); });
  return summary;
}

}  // namespace swept::verify
