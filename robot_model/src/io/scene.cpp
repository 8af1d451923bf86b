// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene.hpp"

#include "io/scene_remarks.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {

World World::load(const std::filesystem::path& scene, const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return load(scene, options); });
  }
  const std::string ending = scene.extension().string();
  const detail::InputSource source(scene.string(), options);
  if (ending == ".urdf") {
    World world = detail::readSceneUrdf(scene, options);
    detail::warnIfEmpty(world, source);
    return world;
  }
  const bool yaml = ending == ".yaml" || ending == ".yml";
  if (!yaml && ending != ".scene") {
    throw InputError(scene.string(), 0,
                     "unknown ending '" + ending +
                         "' of a scene file; allowed are .yaml, .yml, .scene and .urdf");
  }
  const std::string text = readTextFile(scene);
  World world = yaml ? detail::readSceneYaml(text, source) : detail::readSceneText(text, source);
  detail::warnIfEmpty(world, source);
  return world;
}

}  // namespace swept
