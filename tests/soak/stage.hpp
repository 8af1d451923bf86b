// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateSpace.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scenario.hpp"
#include "world_key.hpp"

namespace soak {

/// A robot, its group, and all the bodies that its worlds are made of, each seen twice: by the
/// library and by the oracle. Nothing of it changes; any thread may use it.
class Stage {
 public:
  static constexpr int kForms = 4;  ///< of each place: other sizes, elsewhere

  /// Throws as loading the robot does. `seed` is that of the bodies.
  Stage(const ScenarioFiles& files, std::uint64_t seed, double margin);

  const std::string& name() const { return name_; }  ///< of the robot's file, without its ending
  const ScenarioFiles& files() const { return files_; }
  double margin() const { return margin_; }  ///< m
  int places() const { return static_cast<int>(forms_.front().world.bodies().size()); }
  const swept::WorldBody& body(const Choice& choice) const {
    return forms_[choice.form].world.bodies()[choice.place];
  }
  /// In the empty world: what all versions come from.
  const swept::Checker& empty() const { return *base_.checker; }
  const ompl::base::StateSpacePtr& space() const { return space_; }

  swept::World worldOf(const WorldKey& key) const;
  /// The world as the oracle sees it, with a checker to be judged in it.
  Scenario judged(const WorldKey& key, const swept::Checker& checker) const;
  /// Moves the oracle's bodies, and not the library's, so that answers are wrong: for tests.
  void displaceTwins(const Eigen::Vector3d& metres);

 private:
  ScenarioFiles files_;
  std::string name_;
  double margin_;
  std::vector<Clutter> forms_;
  Scenario base_;
  ompl::base::StateSpacePtr space_;
};

}  // namespace soak
