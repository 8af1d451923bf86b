// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "swept/proofs/path_proof.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

/// Tasks in files with proofs: several trajectories, one after the other, between which the robot
/// grasps and releases objects and senses the world again.
namespace swept {

/// How a body of one phase differs from that in the phase before. No other body may differ.
struct TaskChange {
  /// What has happened to it.
  enum class Kind : std::uint8_t {
    Attached,  ///< a link carries it now: it has the same shapes, where they were
    Placed,    ///< it is in the world now, likewise
    Sensed,    ///< a body of the world that was sensed again, is new or is gone: any other shape
  };
  Kind kind = Kind::Sensed;  ///< see there
  std::string body;          ///< an attached body, or one of the world
};

/// A phase: a trajectory, and all that it is proven under.
struct TaskPhase {
  std::string name;                        ///< for people: `carry the cup`
  std::shared_ptr<const Checker> checker;  ///< robot, group, world and attached bodies
  /// On the clock of the task: its first time is the last one of the phase before. See delayed().
  JointTrajectory trajectory;
  /// Of controllerCurve() of it, with clearances (TrajectoryQuery::clearances). Moving obstacles
  /// are on the clock of the task, too, so TrajectoryQuery::clock is 0.
  TrajectoryCertificate certificate;
  std::vector<TaskChange> changes = {};    ///< since the phase before; none of the first one
  std::vector<std::string> warnings = {};  ///< see writeProof()
};

/// The trajectory with all times later by `seconds`. Rounds them, so its curve differs by that.
JointTrajectory delayed(JointTrajectory trajectory, double seconds);

/// Finds the planes of each phase as writeTrajectoryProof() does. Writes one `.json` file, which
/// verifyTask() and `swept verify` check without any other file. The file is written completely or
/// not at all. `WrittenProof::missing` begins with the phase. Looking for planes, and checking the
/// task before it is written, end soon after `stop` is requested.
///
/// Throws UsageError for phases that do not join (see CheckedTask), with the difference; for no
/// phase; and as writeTrajectoryProof() does. Throws std::invalid_argument as that one does, and
/// for null; SearchStopped for `stop`.
WrittenProof writeTask(const std::filesystem::path& file, std::span<const TaskPhase> phases,
                       const std::stop_token& stop = {});

/// A phase of a task whose proof holds.
struct CheckedPhase {
  std::string name;    ///< as written
  std::string group;   ///< of the joints that move
  double begin = 0.0;  ///< s, on the clock of the task
  double end = 0.0;    ///< s, likewise
  /// Since the phase before, in words: `cup attached to hand`, `cup placed`, `map sensed`.
  std::vector<std::string> changes;
  CheckedProof proof;  ///< of the phase alone; it holds
};

/// The result of checking a task. It holds if the proof of each phase does, as verifyProof() says,
/// and the phases join:
///
/// * All have the same robot.
/// * A phase begins at the time, the configuration of all joints and the velocity (if both have
///   one) at which the phase before ends. Angles without limits may differ by whole turns.
/// * Each body is as before, but for the changes that the file states. A body that is attached or
///   placed has the same shapes, within 1e-9 m of where they were.
///
/// A phase says nothing about pairs that may touch in it (CheckedProof::notChecked).
struct CheckedTask {
  std::string refusal;               ///< the first place where it does not hold; empty: it holds
  std::vector<CheckedPhase> phases;  ///< if it holds

  bool holds() const { return refusal.empty(); }  ///< whether the file's claims are proven
};

/// Checks a file of writeTask(), with the code of robot_model/verify alone. Throws InputError for
/// a file that is no task, and SearchStopped soon after `stop` is requested.
CheckedTask verifyTask(const std::filesystem::path& file, const std::stop_token& stop = {});

/// A phase of a task file, as a controller needs it.
struct TaskStep {
  std::string name;                 ///< as written
  std::string group;                ///< of the joints that move
  JointTrajectory trajectory;       ///< on the clock of the task
  std::vector<TaskChange> changes;  ///< before it begins
};

/// The phases of a file of writeTask(), whose proofs it does not look at. Throws InputError for a
/// file that is no task.
std::vector<TaskStep> readTask(const std::filesystem::path& file);

}  // namespace swept
