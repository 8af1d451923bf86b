// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <system_error>

#include "io/robot_covers.hpp"
#include "io/srdf.hpp"
#include "io/urdf_model.hpp"
#include "io/urdf_outline.hpp"
#include "io/warning_kinds.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {

std::shared_ptr<const Robot> RobotBuilder::build(detail::RobotParts parts) {
  std::shared_ptr<Robot> robot(new Robot());
  robot->name_ = std::move(parts.name);
  robot->modelFrame_ = std::move(parts.modelFrame);
  robot->links_ = std::move(parts.links);
  robot->joints_ = std::move(parts.joints);
  robot->variables_ = std::move(parts.variables);
  robot->groups_ = std::move(parts.groups);
  robot->namedStates_ = std::move(parts.namedStates);
  robot->disabledPairs_ = std::move(parts.disabledPairs);
  robot->enabledPairs_ = std::move(parts.enabledPairs);
  robot->leftOut_ = std::move(parts.leftOut);
  return robot;
}

std::shared_ptr<const Robot> Robot::parse(const std::string& urdfText, const std::string& urdfName,
                                          const std::string& srdfText, const std::string& srdfName,
                                          const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return parse(urdfText, urdfName, srdfText, srdfName, options); });
  }
  detail::RobotParts parts;
  detail::withFewWarnings(options, [&](const LoadOptions& few) {
    const detail::InputSource urdfSource(urdfName, few);
    const detail::InputSource srdfSource(srdfName, few);
    const detail::UrdfOutline outline = detail::outlineUrdf(urdfText, urdfSource);
    detail::SrdfDocument srdf;
    if (!srdfText.empty()) srdf = detail::readSrdf(srdfText, srdfSource);
    parts = detail::assembleRobot(outline, srdf, urdfSource, srdfSource);
    detail::applySrdf(srdf, srdfSource, parts);
  });
  detail::addCovers(parts.links, 0);
  return RobotBuilder::build(std::move(parts));
}

std::shared_ptr<const Robot> Robot::load(const std::filesystem::path& urdf,
                                         const std::filesystem::path& srdf,
                                         const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return load(urdf, srdf, options); });
  }
  const std::string urdfText = readTextFile(urdf);
  if (srdf.empty()) return parse(urdfText, urdf.string(), {}, {}, options);
  const std::string srdfText = readTextFile(srdf);
  if (srdfText.empty()) throw InputError(srdf.string(), 1, "malformed XML: the document is empty");
  return parse(urdfText, urdf.string(), srdfText, srdf.string(), options);
}

std::filesystem::path Robot::srdfBeside(const std::filesystem::path& urdf) {
  std::filesystem::path beside = std::filesystem::path(urdf).replace_extension(".srdf");
  std::error_code ignored;  // no such file is a normal answer
  if (beside == urdf || !std::filesystem::exists(beside, ignored)) return {};
  return beside;
}

}  // namespace swept
