// SPDX-License-Identifier: BSD-3-Clause
#include "input/attach.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "swept/robot_model/did_you_mean.hpp"
#include "command_line/exit_code.hpp"
#include "input/poses.hpp"
#include "input/states.hpp"
#include "output/markup_text.hpp"
#include "output/text_output.hpp"

namespace swept {
namespace {

struct Spec {
  std::string shape, link, pose;
};

/// Names of files may have an `@` or a `:` in them; links have none.
Spec specOf(const std::string& text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw UsageError("--attach '" + text +
                     "': expected SHAPE@LINK or SHAPE@LINK:X,Y,Z[,QX,QY,QZ,QW]");
  Spec spec{.shape = text.substr(0, at), .link = text.substr(at + 1), .pose = {}};
  const std::size_t colon = spec.link.find(':');
  if (colon == std::string::npos) return spec;
  spec.pose = spec.link.substr(colon + 1);
  spec.link.resize(colon);
  return spec;
}

std::optional<Shape> primitive(const std::string& text, const std::string& label,
                               const Warn& warn) {
  const auto sizes = [&](const std::string& type, const std::vector<std::string>& names) {
    std::vector<double> values = readValues(text.substr(type.size() + 1), names, label);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(values[i] >= 0.0))
        throw UsageError(label + ": " + names[i] + " is " + shortNumber(values[i]) +
                         ", allowed is from 0 m");
    if (std::ranges::find(values, 0.0) != values.end() && warn)
      warn("swept: warning: " + label + ": a shape with a size of 0 is checked as the point, " +
           "segment or surface that it is");
    return values;
  };
  if (text.starts_with("box:")) {
    const auto v = sizes("box", {"x", "y", "z"});
    return makeBox({v[0], v[1], v[2]});
  }
  if (text.starts_with("sphere:")) return makeSphere(sizes("sphere", {"radius"})[0]);
  if (text.starts_with("cylinder:")) {
    const auto v = sizes("cylinder", {"radius", "length"});
    return makeCylinder(v[0], v[1]);
  }
  return std::nullopt;
}

/// Read as a link's mesh would be.
Shape meshOf(const std::string& file, const LoadOptions& options) {
  if (!std::filesystem::exists(file)) throw InputError(file, 0, "file not found");
  const std::string urdf =
      "<robot name=\"attached\"><link name=\"body\"><collision><geometry><mesh filename=\"" +
      markupText(std::filesystem::absolute(file).string()) +
      "\"/></geometry></collision></link></robot>";
  return Robot::parse(urdf, file, {}, {}, options)->links().front().collision.front().shape;
}

std::vector<std::string> linkNames(const Robot& robot) {
  std::vector<std::string> names;
  for (const Link& link : robot.links()) names.push_back(link.name);
  return names;
}

std::string nameOf(const Spec& spec, bool isPrimitive, const std::vector<AttachedBody>& others) {
  const std::string base = isPrimitive ? spec.shape.substr(0, spec.shape.find(':'))
                                       : std::filesystem::path(spec.shape).stem().string();
  std::string name = base;
  for (int number = 2; std::ranges::find(others, name, &AttachedBody::name) != others.end();
       ++number)
    name = base + " " + std::to_string(number);
  return name;
}

}  // namespace

std::vector<AttachedBody> attachedBodies(const Arguments& args, const Robot& robot,
                                         const LoadOptions& options,
                                         std::vector<AttachedBody> carried) {
  std::vector<AttachedBody> bodies = std::move(carried);
  for (const std::string& text : args.attached) {
    const Spec spec = specOf(text);
    const std::string label = "--attach '" + text + "'";
    if (!robot.findLink(spec.link))
      throw UsageError(label + ": robot '" + robot.name() + "' has no link '" + spec.link + "'" +
                       didYouMean(spec.link, linkNames(robot)));
    const Eigen::Isometry3d pose =
        spec.pose.empty() ? Eigen::Isometry3d::Identity() : readPlace(spec.pose, label);
    const std::optional<Shape> shape = primitive(spec.shape, label, options.warn);
    AttachedBody body{.name = nameOf(spec, shape.has_value(), bodies),
                      .link = spec.link,
                      .parts = {},
                      .touchLinks = {}};
    body.parts.push_back({shape ? *shape : meshOf(spec.shape, options), pose});
    bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace swept
