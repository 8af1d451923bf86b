// SPDX-License-Identifier: BSD-3-Clause
#include "check.hpp"

#include <algorithm>

#include "enclosed.hpp"
#include "encoding.hpp"
#include "environment.hpp"
#include "motion.hpp"
#include "proof.hpp"

namespace swept::verify {
namespace {

/// rad or m. How far beyond a limit a state may be: 1e-5, and the rounding of such a decimal. The
/// proof is about the state as it is.
constexpr double kLimit = 1.000001e-5;
const std::string kChanged = ": is not as it was when the path was certified";

const Json& readArray(const Json& json, const char* key, const std::string& where) {
  const Json& list = at(json, key, where);
  if (!list.is_array()) throw Refusal(where + ": " + key + " is not a list");
  return list;
}

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
  ProofCheck(const Json& path, const Json& modelJson)
      : path_(path), proof_(at(path, "proof", "path")) {
    requireSameModel(proof_, modelJson);
    model_ = readModel(modelJson);
    requireSameClaims();
    const Json& states = readArray(path, "states", "path");
    for (std::size_t i = 0; i < states.size(); ++i)
      states_.push_back(readState(states[i], model_, "state " + std::to_string(i + 1)));
    if (states_.size() < 2) throw Refusal("states: fewer than two");
    pairs_ = pairsToProve(model_);
  }

  Summary run() {
    const Json& segments = readArray(proof_, "segments", "proof");
    if (segments.size() + 1 != states_.size())
      throw Refusal("proof, segments: " + std::to_string(segments.size()) + ", and " +
                    std::to_string(states_.size()) + " states");
    // Changed states first: otherwise the message would name consequences of them.
    for (std::size_t i = 0; i < segments.size(); ++i) requireStates(segments, i);
    for (std::size_t i = 0; i < segments.size(); ++i) checkSegment(segments[i], i);
    summary_.segments = segments.size();
    summary_.pairs = pairs_.size();
    for (const auto& [pair, reason] : model_.allowed)
      summary_.allowed[reason].push_back(nameOf({pair.first, pair.second}));
    return summary_;
  }

 private:
  /// The file's claims besides states and proof: users of the robot rely on them.
  void requireSameClaims() const {
    compareDigests(at(at(proof_, "digests", "proof"), "claims", "digests"), claimDigests(path_),
                   "path file,");
    const Json& names = readArray(path_, "joint_names", "path");
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

  std::string nameOf(PairToProve pair) const {
    return model_.bodies[static_cast<std::size_t>(pair.a)].name() + " - " +
           model_.bodies[static_cast<std::size_t>(pair.b)].name();
  }

  bool statesFit(const Json& segments, std::size_t i) const {
    const Json& states = path_["states"];
    return at(segments[i], "states_digest", "segment " + std::to_string(i + 1)) ==
           stateDigest(states[i], states[i + 1]);
  }

  /// Names the state that two segments share, if neither matches.
  void requireStates(const Json& segments, std::size_t i) const {
    if (statesFit(segments, i)) return;
    const bool next = i + 1 < segments.size() && !statesFit(segments, i + 1);
    const std::size_t state = next || i + 1 == segments.size() ? i + 2 : i + 1;
    throw Refusal("state " + std::to_string(state) + kChanged);
  }

  void checkSegment(const Json& segment, std::size_t i) {
    const std::string where = "segment " + std::to_string(i + 1);
    const Motion motion(model_, states_[i], states_[i + 1]);
    const Json& proofs = readArray(segment, "pairs", where);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
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
  }

  const Json& path_;
  const Json& proof_;
  Model model_;
  std::vector<std::vector<double>> states_;
  std::vector<PairToProve> pairs_;
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
        "rules: the group, its limits, margins or pairs that may touch are not as they "
        "were when the path was certified");
}

Json digestsOf(const Json& model) {
  Json digests = {{"joints", Json::object()}, {"bodies", Json::object()}};
  Json rules = model;
  for (const char* kind : {"joints", "bodies"}) {
    for (const Json& item : readArray(model, kind, "model")) {
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
    if (key != "states" && key != "proof" && key != "model" && key != "inputs")
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

Summary checkProof(const Json& path, const Json& model) {
  Summary summary;
  inDefaultEnvironment([&] { summary = ProofCheck(path, model).run(); });
  return summary;
}

}  // namespace swept::verify
