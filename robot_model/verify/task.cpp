// SPDX-License-Identifier: BSD-3-Clause
#include "task.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "check.hpp"
#include "encoding.hpp"
#include "environment.hpp"
#include "motion.hpp"
#include "task_bodies.hpp"
#include "trajectory.hpp"

namespace swept::verify {
namespace {

void requireExactly(const Json& json, const std::set<std::string>& keys, const std::string& where) {
  if (!json.is_object()) throw Refusal(where + ": not an object");
  for (const std::string& key : keys) static_cast<void>(at(json, key.c_str(), where));
  for (const auto& [key, value] : json.items())
    if (!keys.contains(key)) throw Refusal(where + ": it has no " + key);
}

/// Where a joint is and how fast at one end of a phase.
struct JointEnd {
  std::vector<double> values;      ///< rad or m
  std::vector<double> velocities;  ///< likewise, per s; empty: the point has none
};

/// A phase without its bodies' shapes: what joins are about.
class Phase {
 public:
  Phase(const Json& json, std::size_t index)
      : where_("phase " + std::to_string(index + 1)), before_("phase " + std::to_string(index)) {
    requireExactly(json, {"phase", "changes", "path", "digest"}, where_);
    if (!json["phase"].is_string()) throw Refusal(where_ + ": its name is not a text");
    name_ = json["phase"];
    where_ += " (" + name_ + ")";
    path_ = &json["path"];
    if (!path_->is_object()) throw Refusal(where_ + ", path: not an object");
    if (!path_->contains("trajectory")) throw Refusal(where_ + ": there is no trajectory");
    modelJson_ = &at(*path_, "model", where_);
    // What moves by itself does so on the clock of the task.
    if (path_->contains("clock") && (*path_)["clock"] != 0.0)
      throw Refusal(where_ + ": the clock of what moves shows " + (*path_)["clock"].dump() +
                    " s at the task's time 0");
  }

  const std::string& name() const { return name_; }
  const std::string& where() const { return where_; }
  const std::string& before() const { return before_; }
  const Json& path() const { return *path_; }
  const Json& modelJson() const { return *modelJson_; }
  const Model& model() const { return model_; }
  const Point& first() const { return points_.front(); }
  const Point& last() const { return points_.back(); }

  /// After its proof was checked.
  void read() {
    Json frames = *modelJson_;
    frames["bodies"] = frames["allowed"] = Json::array();
    frames["paddings"] = Json::object();
    frames.erase("asked");
    model_ = readModel(frames);
    points_ = readPoints((*path_)["trajectory"], model_);
  }

  JointEnd endOf(const Joint& joint, const Point& point) const {
    JointEnd end{.values = joint.values, .velocities = {}};
    const std::size_t count = valuesOf(joint.kind);
    if (joint.variable < 0) {
      end.velocities.assign(count, 0.0);
      return end;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t variable = static_cast<std::size_t>(joint.variable) + i;
      end.values.push_back(joint.multiplier * point.positions[variable] + joint.offset);
      if (!point.velocities.empty())
        end.velocities.push_back(joint.multiplier * point.velocities[variable]);
    }
    return end;
  }
  bool isCyclic(const Joint& joint) const {
    return valuesOf(joint.kind) == 1 && joint.variable >= 0 &&
           model_.variables[static_cast<std::size_t>(joint.variable)].cyclic;
  }
  /// model_from_link at the first point.
  Eigen::Isometry3d poseOf(const std::string& link) const {
    const auto found = std::ranges::find(model_.links, link) - model_.links.begin();
    return Motion(model_, first().positions, first().positions)
        .at(static_cast<int>(found), -1, 0.0)
        .reference_from_link;
  }

 private:
  std::string name_, where_, before_;
  const Json* path_;
  const Json* modelJson_;
  Model model_;
  std::vector<Point> points_;
};

std::string numberOf(double number) {
  return numberText(number, 9);
}

/// What the robot is, whichever group moves it.
void requireSameRobot(const Phase& last, const Phase& next) {
  const Json &before = last.modelJson(), &now = next.modelJson();
  const std::string as = " as in " + next.before();
  if (before["links"] != now["links"]) throw Refusal(next.where() + ": the links are not" + as);
  const Json &joints = before["joints"], &own = now["joints"];
  if (joints.size() != own.size()) throw Refusal(next.where() + ": the joints are not" + as);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const std::string name = own[i]["name"];
    const std::string where = next.where() + ", joint " + name + ": it is not";
    for (const char* key : {"name", "type", "parent", "child", "pose", "axis", "planar_x"})
      if (joints[i].value(key, Json()) != own[i].value(key, Json())) throw Refusal(where + as);
    const Json &a = joints[i]["variable"], &b = own[i]["variable"];
    if (a.is_null() || b.is_null()) continue;
    const Json& variable = before["variables"][a.get<std::size_t>()];
    if (variable != now["variables"][b.get<std::size_t>()])
      throw Refusal(where + " moved by the same variable with the same limits" + as);
    for (const char* key : {"multiplier", "offset"})
      if (joints[i][key] != own[i][key]) throw Refusal(where + as);
  }
}

bool differ(double before, double now, bool cyclic) {
  if (!cyclic) return !(before == now);
  return !(std::abs(std::remainder(now - before, 2.0 * std::numbers::pi)) <= kTurnedBy);
}

void requireSameState(const Phase& last, const Phase& next) {
  if (!(next.first().time == last.last().time))
    throw Refusal(next.where() + ": it begins at " + numberOf(next.first().time) + " s, and " +
                  next.before() + " ends at " + numberOf(last.last().time) + " s");
  for (std::size_t i = 0; i < next.model().joints.size(); ++i) {
    const Joint &joint = next.model().joints[i], &same = last.model().joints[i];
    const JointEnd before = last.endOf(same, last.last()), now = next.endOf(joint, next.first());
    const bool cyclic = last.isCyclic(same) || next.isCyclic(joint);
    const std::string where = next.where() + ", joint " + joint.name + ": it begins ";
    const std::string and_ = ", and " + next.before() + " ends ";
    for (std::size_t k = 0; k < now.values.size(); ++k)
      if (differ(before.values[k], now.values[k], cyclic))
        throw Refusal(where + "at " + numberOf(now.values[k]) + and_ + "at " +
                      numberOf(before.values[k]));
    if (before.velocities.empty() || now.velocities.empty()) continue;
    for (std::size_t k = 0; k < now.velocities.size(); ++k)
      if (!(before.velocities[k] == now.velocities[k]))
        throw Refusal(where + "with a velocity of " + numberOf(now.velocities[k]) + and_ +
                      "with one of " + numberOf(before.velocities[k]));
  }
}

}  // namespace

std::vector<PhaseSummary> checkTask(const Json& task, const Pause& pause) {
  std::vector<PhaseSummary> summaries;
  inDefaultEnvironment([&] {
    requireExactly(task, {"robot", "phases", "digest"}, "task");
    const Json& list = readList(task, "phases", "task");
    if (list.empty()) throw Refusal("task: there is no phase");
    std::vector<Phase> phases;
    for (std::size_t i = 0; i < list.size(); ++i) phases.emplace_back(list[i], i);
    for (std::size_t i = 0; i < list.size(); ++i) {
      Phase& phase = phases[i];
      PhaseSummary summary{.name = phase.name(), .group = {}, .changes = {}, .proof = {}};
      try {
        summary.proof = checkProof(phase.path(), phase.modelJson(), pause);
      } catch (const Refusal& refusal) {
        throw Refusal(phase.where() + ", " + refusal.what());
      }
      phase.read();
      const Json& group = at(phase.path(), "group", phase.where());
      if (group.is_string()) summary.group = group;
      if (at(phase.path(), "robot", phase.where()) != task["robot"])
        throw Refusal(phase.where() + ": its robot is not that of the task");
      summary.begin = phase.first().time;
      summary.end = phase.last().time;
      const BodyChanges changes(list[i]["changes"], phase.where());
      if (i == 0) {
        changes.requireNone();
      } else {
        requireSameRobot(phases[i - 1], phase);
        requireSameState(phases[i - 1], phase);
        summary.changes =
            changes.check({.before = phases[i - 1].modelJson()["bodies"],
                           .now = phase.modelJson()["bodies"],
                           .phaseBefore = phase.before(),
                           .poseOf = [&](const std::string& link) { return phase.poseOf(link); }});
      }
      if (list[i]["digest"] != phaseDigest(list[i]))
        throw Refusal(phase.where() + ": it is not as it was when the task was written");
      summaries.push_back(std::move(summary));
    }
    if (task["digest"] != taskDigest(task))
      throw Refusal("task: its phases are not those that it was written with");
  });
  return summaries;
}

std::string phaseDigest(Json phase) {
  phase.erase("digest");
  return digestOf(phase.dump());
}

std::string taskDigest(Json task) {
  task.erase("digest");
  for (Json& phase : task["phases"]) phase = phase["digest"];
  return digestOf(task.dump());
}

}  // namespace swept::verify
