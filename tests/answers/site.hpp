// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "random.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept::answers {

using Values = std::vector<double>;

/// A group of a robot in one scene.
struct Site {
  std::string robot;  ///< `FILE:GROUP`, or `FILE:-` for what is asked about the robot alone
  std::string scene;  ///< `-` for the latter
  std::shared_ptr<const Robot> model;
  std::optional<Checker> checker;  ///< none: of the robot alone
  std::vector<Values> anchors;     ///< configurations of the group that tasks begin or end in
};

/// How a site is made, when its turn comes.
struct Place {
  std::string robot;
  std::string scene;
  /// Throws what the library throws where it refuses the scene.
  std::function<Site()> make;
};

/// Where robots and scenes are.
struct Folders {
  std::filesystem::path models;                ///< `models` of the source tree, or one like it
  std::optional<std::filesystem::path> data;   ///< see dataFolder()
  std::optional<std::filesystem::path> extra;  ///< robots and scenes below it are added
};

/// Every group that anything is checked of, in every scene; of robots whose file or group matches.
/// What cannot be loaded is told to `remark`.
std::vector<Place> makePlaces(const Folders& folders, std::uint64_t seed, const std::regex& robots,
                              const std::function<void(const std::string&)>& remark);

/// The names of the scenes that are made at random.
const std::vector<std::string>& randomScenes();
/// One of these: names, numbers and options follow from the seed.
Checker makeRandomScene(const std::string& scene, const std::shared_ptr<const Robot>& robot,
                        const std::string& group, Random random);

}  // namespace swept::answers
