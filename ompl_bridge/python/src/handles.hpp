// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/work_cell.hpp"
#include "swept/robot_model/world.hpp"
#include "watch.hpp"

/// What the classes of Python hold of those of C++.
namespace swept::python {

/// The files of a robot or a world, and how they are read: what its pickle has.
struct Source {
  std::filesystem::path file;  ///< absolute; empty: there is none
  std::filesystem::path srdf;  ///< absolute; empty: none
  std::vector<std::pair<std::string, std::filesystem::path>> packages = {};  ///< by name
  std::filesystem::path cache = {};                                          ///< empty: none
  std::string modelFrame = {};                                               ///< see LoadOptions
  bool childProcess = true;                                                  ///< likewise
  /// What a robot of several is composed of, in place of `file`; else null.
  std::shared_ptr<const WorkCell> cell = {};
};

/// swept.Robot.
struct RobotHandle {
  std::shared_ptr<const Robot> robot;  ///< never null
  Source source;
  /// Added to what the files have: names, and their joints.
  std::vector<std::pair<std::string, std::vector<std::string>>> groups = {};
};

/// swept.World.
struct WorldHandle {
  World world;
  Source source = {};
  bool changed = true;  ///< the world is not that of the file
};

/// swept.Checker: with workspaces for the threads that query it. The GIL guards them.
class CheckerHandle {
 public:
  CheckerHandle(RobotHandle robot, Checker checker)
      : robot_(std::move(robot)), checker_(std::make_shared<const Checker>(std::move(checker))) {}
  CheckerHandle(RobotHandle robot, std::shared_ptr<const Checker> checker)
      : robot_(std::move(robot)), checker_(std::move(checker)) {}

  CheckerHandle(CheckerHandle&&) = default;
  CheckerHandle& operator=(CheckerHandle&&) = default;
  ~CheckerHandle() = default;

  const RobotHandle& robot() const { return robot_; }
  const Checker& checker() const { return *checker_; }
  const std::shared_ptr<const Checker>& shared() const { return checker_; }
  /// Of a configuration.
  std::size_t dimension() const { return static_cast<std::size_t>(checker_->dimension()); }
  Pace& paceOfStates() { return paceOfStates_; }    ///< of checkStates()
  Pace& paceOfMotions() { return paceOfMotions_; }  ///< of certifyMotions()
  /// A version of the checker: of the same robot.
  CheckerHandle version(Checker checker) const { return {robot_, std::move(checker)}; }

  /// A workspace for the time of a query. Make and destroy it with the GIL held.
  class Lease {
   public:
    explicit Lease(CheckerHandle& handle) : idle_(handle.idle_) {
      if (idle_.empty()) {
        workspace_ = std::make_unique<Workspace>(handle.checker());
      } else {
        workspace_ = std::move(idle_.back());
        idle_.pop_back();
      }
    }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    ~Lease() { idle_.push_back(std::move(workspace_)); }
    Workspace& operator*() const { return *workspace_; }

   private:
    std::vector<std::unique_ptr<Workspace>>& idle_;
    std::unique_ptr<Workspace> workspace_;
  };

 private:
  RobotHandle robot_;
  std::shared_ptr<const Checker> checker_;
  std::vector<std::unique_ptr<Workspace>> idle_;
  Pace paceOfStates_, paceOfMotions_;
};

/// The swept.Group of a robot's group.
pybind11::object makeGroup(std::shared_ptr<const Robot> robot, const Group& group);

}  // namespace swept::python
