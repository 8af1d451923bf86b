// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene.hpp"

#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {

namespace detail {

namespace {

PlanningScene readAnyScene(const std::filesystem::path& scene, const Robot* robot,
                           const LoadOptions& options, const InputSource& source) {
  const std::string ending = scene.extension().string();
  if (ending == ".urdf") return {.world = readSceneUrdf(scene, options)};
  const bool yaml = ending == ".yaml" || ending == ".yml";
  if (!yaml && ending != ".scene") {
    throw InputError(scene.string(), 0,
                     "unknown ending '" + ending +
                         "' of a scene file; allowed are .yaml, .yml, .scene and .urdf");
  }
  const std::string text = readTextFile(scene);
  if (yaml) return readSceneYaml(text, source, robot);
  return {.world = readSceneText(text, source)};
}

/// A user who names a scene takes Free for an answer about that scene.
void warnIfEmpty(const World& world, const InputSource& source) {
  // Readers refuse bodies without geometry.
  if (world.bodies().empty() && world.obstacles().empty())
    source.warnOfUnchecked(0,
                           "no body of the scene has geometry: the robot is checked in an "
                           "empty world");
}

}  // namespace

PlanningScene readScene(const std::filesystem::path& scene, const Robot* robot,
                        const LoadOptions& options) {
  const InputSource source(scene.string(), options);
  PlanningScene read = readAnyScene(scene, robot, options, source);
  warnIfEmpty(read.world, source);
  return read;
}

}  // namespace detail

World World::load(const std::filesystem::path& scene, const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return load(scene, options); });
  }
  return detail::readScene(scene, nullptr, options).world;
}

PlanningScene PlanningScene::load(const std::filesystem::path& file, const Robot& robot,
                                  const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return load(file, robot, options); });
  }
  LoadOptions own = options;
  if (own.modelFrame.empty()) own.modelFrame = robot.modelFrame();
  return detail::readScene(file, &robot, own);
}

CheckerOptions PlanningScene::checkerOptions(CheckerOptions own) const {
  if (!own.reference) own.reference = state;
  own.attached.insert(own.attached.begin(), attached.begin(), attached.end());
  own.rules = own.rules.over(rules);
  return own;
}

}  // namespace swept
