// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_visuals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "page/packed.hpp"

namespace swept {
namespace {

using MeshPointer = std::shared_ptr<const VisualMesh>;

template <typename Vertices>
Eigen::AlignedBox3d boxOf(const Vertices& vertices) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : vertices) box.extend(vertex.template cast<double>());
  return box;
}

bool isSameMesh(const TriangleMesh& checked, const VisualMesh& shown) {
  if (checked.triangles().size() != shown.triangles.size()) return false;
  const Eigen::AlignedBox3d a = boxOf(checked.vertices()), b = boxOf(shown.vertices);
  const double off = std::max((a.min() - b.min()).cwiseAbs().maxCoeff(),
                              (a.max() - b.max()).cwiseAbs().maxCoeff());
  return off <= 1e-5 * a.sizes().maxCoeff();
}

/// The collision geometry of the link that has the same file at the same scale; null: none has.
const Shape* checkedShape(const Link& link, const Visual& visual) {
  const auto* mesh = std::get_if<MeshPointer>(&visual.shape);
  if (mesh == nullptr) return nullptr;
  for (const CollisionGeometry& piece : link.collision) {
    const auto* checked = std::get_if<TriangleMesh>(&piece.shape);
    if (checked != nullptr && piece.source == visual.source && isSameMesh(*checked, **mesh))
      return &piece.shape;
  }
  return nullptr;
}

int geometryOf(const Link& link, const Visual& visual, PageGeometries& geometries) {
  if (const Shape* checked = checkedShape(link, visual)) return geometries.indexOf(*checked);
  return std::visit(
      [&]<typename T>(const T& shape) {
        if constexpr (std::is_same_v<T, MeshPointer>)
          return geometries.indexOf(shape);
        else
          return geometries.indexOf(Shape(shape));
      },
      visual.shape);
}

}  // namespace

std::vector<int> linksWithVisuals(const Robot& robot, const VisualModel& visuals) {
  std::vector<int> links;
  for (const LinkVisuals& link : visuals.links)
    if (const auto index = robot.findLink(link.link); index && !link.visuals.empty())
      links.push_back(*index);
  return links;
}

std::string cssColour(const Colour& colour) {
  std::array<char, 8> text{};
  const auto part = [](double value) { return static_cast<int>(std::lround(255.0 * value)); };
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", part(colour.red), part(colour.green),
                part(colour.blue));
  return text.data();
}

Json visualsJson(const Robot& robot, const VisualModel& visuals, const PageFrames& frames,
                 PageGeometries& geometries) {
  Json json = Json::array();
  for (const LinkVisuals& looks : visuals.links) {
    const auto index = robot.findLink(looks.link);
    if (!index) continue;
    const Link& link = robot.links()[static_cast<std::size_t>(*index)];
    const auto frame = std::ranges::find(frames.links, *index) - frames.links.begin();
    for (const Visual& visual : looks.visuals) {
      std::vector<float> pose;
      appendPose(pose, visual.link_from_shape);
      json.push_back({{"frame", frame},
                      {"geometry", geometryOf(link, visual, geometries)},
                      {"pose", packed<float>(pose)},
                      {"colour", visual.colour ? Json(cssColour(*visual.colour)) : Json(nullptr)},
                      {"opacity", visual.colour ? visual.colour->alpha : 1.0}});
    }
  }
  return json;
}

std::string visualsText(const VisualModel& visuals) {
  std::size_t shapes = 0;
  for (const LinkVisuals& link : visuals.links) shapes += link.visuals.size();
  std::vector<std::string> parts;
  if (shapes > 0) parts.push_back(countedText(shapes, "shape"));
  if (visuals.triangles < visuals.trianglesOfFile)
    parts.push_back("drawn with " + std::to_string(visuals.triangles) + " of " +
                    std::to_string(visuals.trianglesOfFile) + " triangles");
  else if (visuals.triangles > 0)
    parts.push_back(countedText(visuals.triangles, "triangle"));
  if (visuals.leftOut > 0) parts.push_back(std::to_string(visuals.leftOut) + " left out");
  return joined(parts);
}

}  // namespace swept
