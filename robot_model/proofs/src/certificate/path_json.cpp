// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/path_json.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "certificate/constraints_json.hpp"
#include "certificate/trajectory_json.hpp"
#include "output/clouds_json.hpp"
#include "output/unchecked_json.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "verify/check.hpp"

namespace swept {
namespace {

/// A list with each item on a line of its own.
std::string itemLines(const Json& list) {
  std::string text = "[";
  for (const Json& item : list) text += (text.back() == '[' ? "\n  " : ",\n  ") + item.dump();
  return text + "]";
}

std::vector<std::string> jointNames(const Checker& checker) {
  std::vector<std::string> names;
  for (const int variable : checker.group().variables)
    names.push_back(checker.robot().variables()[variable].name);
  return names;
}

}  // namespace

std::vector<double> ProvenPath::clearances() const {
  std::vector<double> least;
  for (const SegmentRecord& segment : segments) least.push_back(segment.clearance);
  return least;
}

ProvenPath provenPath(const ConfigurationList& states, const PathCertificate& certificate) {
  ProvenPath path;
  for (const ConfigurationView& q : states) path.states.emplace_back(q.begin(), q.end());
  // What is proven of a single state is that the motion which stays there is free.
  if (path.states.size() == 1) path.states.push_back(path.states.front());
  if (certificate.segments.size() + 1 != path.states.size())
    throw std::invalid_argument("a certificate of " + std::to_string(certificate.segments.size()) +
                                " segments is not of a path of " + std::to_string(states.size()) +
                                " states");
  for (const CertifiedSegment& segment : certificate.segments) {
    SegmentRecord record{
        .verdict = segment.certificate.verdict, .clearance = 0.0, .clearances = {}};
    if (segment.clearance) {
      record.clearance = segment.clearance->lower;
      record.clearances = clearancesOf(*segment.clearance);
    } else if (record.verdict == Verdict::Free) {
      throw std::invalid_argument("a proof needs a certificate with clearances");
    }
    path.segments.push_back(std::move(record));
  }
  return path;
}

ProvenPath provenPath(const JointTrajectory& trajectory, const TrajectoryCertificate& certificate) {
  ProvenPath path;
  for (const TrajectoryPoint& point : trajectory.points) path.states.push_back(point.positions);
  if (path.states.size() < 2)
    throw std::invalid_argument("a proof needs a trajectory of two points or more");
  const bool isFree = certificate.verdict == Verdict::Free;
  if (isFree && certificate.freeUntil != trajectory.points.back().time)
    throw std::invalid_argument("a certificate of another trajectory");
  if (isFree && (!certificate.world || !certificate.self))
    throw std::invalid_argument("a proof needs a certificate with clearances");
  SegmentRecord record{.verdict = certificate.verdict, .clearance = 0.0, .clearances = {}};
  if (certificate.world && certificate.self) {
    record.clearance = std::min(certificate.world->lower, certificate.self->lower);
    const auto nearest = [](const TrajectoryClearance& own) {
      return NearestPair{.clearance = own.lower, .bodyA = own.bodyA, .bodyB = own.bodyB};
    };
    record.clearances = {nearest(*certificate.world), nearest(*certificate.self)};
  }
  path.segments.assign(path.states.size() - 1, record);
  return path;
}

// Writes each member of the first two levels, each point of a trajectory and each pair of a proof
// on a line of its own.
std::string pathLines(const Json& path) {
  std::string text = "{";
  for (const auto& [key, value] : path.items()) {
    text += (text.size() > 1 ? ",\n " : "\n ") + Json(key).dump() + ": ";
    if (key == "proof" && !value.is_null()) {
      text += "{\n  \"digests\": " + value["digests"].dump() + ",\n  \"segments\": [";
      for (const Json& segment : value["segments"]) {
        text += (text.back() == '[' ? "\n   " : ",\n   ");
        text += "{\"states_digest\": " + segment["states_digest"].dump() + ", \"pairs\": [";
        for (const Json& pair : segment["pairs"])
          text += (text.back() == '[' ? "\n    " : ",\n    ") + pair.dump();
        text += "]}";
      }
      text += "]}";
    } else if (key == "trajectory") {
      text += "{\"variables\": " + value["variables"].dump() +
              ", \"points\": " + itemLines(value["points"]) + "}";
    } else if (value.is_array()) {
      text += itemLines(value);
    } else {
      text += value.dump();
    }
  }
  return text + "\n}\n";
}

Json pathJson(const Checker& checker, const PathRecord& record, const Certificate& certificate,
              bool embed, const std::string& where) {
  Json json = {{"robot", checker.robot().name()}, {"group", checker.group().name}};
  json.update(record.maker);
  json["margin"] = checker.options().margin;
  if (checker.options().selfMargin) json["margin_self"] = *checker.options().selfMargin;
  if (checker.options().worldMargin) json["margin_world"] = *checker.options().worldMargin;
  json["tolerance"] = checker.options().tolerance;
  json["clouds"] = cloudsJson(checker.world());
  json["joint_names"] = jointNames(checker);
  if (!checker.options().constraints.empty()) json["constraints"] = constraintsJson(checker);
  if (!record.lines.empty()) json["lines"] = record.lines;
  // Of what is in the model: obstacles without geometry are not.
  if (std::ranges::any_of(checker.world().obstacles(),
                          [](const MovingObstacle& moving) { return !moving.parts.empty(); }))
    json["clock"] = record.clock;
  json["states"] = Json::array();
  for (const std::vector<double>& q : record.states) json["states"].push_back(toJson(q));
  if (record.trajectory != nullptr) json["trajectory"] = trajectoryJson(*record.trajectory);
  json["segments"] = Json::array();
  for (const SegmentRecord& segment : record.segments) {
    json["segments"].push_back(
        {{"verdict", toString(segment.verdict)}, {"clearance", finiteOrNull(segment.clearance)}});
    addClearances(segment.clearances, json["segments"].back());
  }
  addUnchecked(json, checker, record.warnings);
  if (!record.inputs.is_null()) json["inputs"] = record.inputs;
  requireUtf8(json, where);
  if (embed) json["model"] = certificate.model;
  json["proof"] = certificate.proof;
  if (!certificate.proof.is_null()) json["proof"]["digests"]["claims"] = verify::claimDigests(json);
  return json;
}

std::string pathText(const Json& path, const std::string& where) {
  std::string text = pathLines(path);
  if (text.size() > kMaxTextBytes)
    throw UsageError(where + ": with its proof the path takes " + std::to_string(text.size()) +
                     " bytes, and files of more than " + std::to_string(kMaxTextBytes) +
                     " are not read; proofs of parts of the path are smaller");
  return text;
}

}  // namespace swept
