// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line/commands.hpp"
#include "output/clearance_text.hpp"
#include "page/pages.hpp"
#include "page/program_page.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr Colour kModelColour{0.2, 0.5, 0.9, 1.0};
constexpr Colour kOutsideColour{0.9, 0.1, 0.1, 1.0};

using Corners = std::array<Vector3d, 3>;

/// Around z, from the outline (across, along).
std::vector<Corners> turned(const std::vector<Eigen::Vector2d>& outline) {
  constexpr int kSides = 32;
  std::vector<Corners> triangles;
  for (int side = 0; side < kSides; ++side)
    for (std::size_t i = 1; i < outline.size(); ++i) {
      const auto point = [&](std::size_t at, int k) {
        const double angle = 2.0 * std::numbers::pi * k / kSides;
        return Vector3d(outline[at].x() * std::cos(angle), outline[at].x() * std::sin(angle),
                        outline[at].y());
      };
      triangles.push_back({point(i - 1, side), point(i - 1, side + 1), point(i, side + 1)});
      triangles.push_back({point(i - 1, side), point(i, side + 1), point(i, side)});
    }
  return triangles;
}

std::vector<Corners> roundTriangles(double radius, double halfLength) {
  constexpr int kSteps = 12;
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i <= 2 * kSteps + 1; ++i) {
    const bool isUpper = i > kSteps;
    const double angle = std::numbers::pi * ((isUpper ? i - 1 : i) - kSteps) / (2.0 * kSteps);
    outline.emplace_back(radius * std::cos(angle),
                         radius * std::sin(angle) + (isUpper ? halfLength : -halfLength));
  }
  return turned(outline);
}

std::vector<Corners> trianglesOf(const std::vector<Vector3d>& vertices,
                                 const std::vector<Eigen::Vector3i>& triangles) {
  std::vector<Corners> corners;
  for (const Eigen::Vector3i& t : triangles)
    corners.push_back({vertices[static_cast<std::size_t>(t[0])],
                       vertices[static_cast<std::size_t>(t[1])],
                       vertices[static_cast<std::size_t>(t[2])]});
  return corners;
}

/// The surface of a shape, to be looked at; empty for those that robots do not have.
std::vector<Corners> surfaceOf(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape))
    return trianglesOf({mesh->vertices().begin(), mesh->vertices().end()},
                       {mesh->triangles().begin(), mesh->triangles().end()});
  if (const auto* hull = std::get_if<ConvexHull>(&shape))
    return trianglesOf(hull->vertices(), hull->faces());
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return roundTriangles(sphere->radius, 0.0);
  if (const auto* capsule = std::get_if<Capsule>(&shape))
    return roundTriangles(capsule->radius, capsule->halfLength);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    const auto& [radius, half] = *cylinder;
    return turned({{0.0, -half}, {radius, -half}, {radius, half}, {0.0, half}});
  }
  const auto* box = std::get_if<Box>(&shape);
  if (box == nullptr) return {};
  std::vector<Vector3d> corners;
  for (int k = 0; k < 8; ++k)
    corners.emplace_back(box->halfExtents.cwiseProduct(
        Vector3d((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1)));
  const ConvexHull hull = ConvexHull::of(corners);
  return trianglesOf(hull.vertices(), hull.faces());
}

/// m: how far the point is in front of the shape's surface, at least.
double inFrontOf(const PosedShape& posed, const Vector3d& point) {
  const Vector3d p = posed.body_from_shape.inverse() * point;
  if (const auto* sphere = std::get_if<Sphere>(&posed.shape)) return p.norm() - sphere->radius;
  if (const auto* box = std::get_if<Box>(&posed.shape))
    return (p.cwiseAbs() - box->halfExtents).maxCoeff();
  if (const auto* cylinder = std::get_if<Cylinder>(&posed.shape))
    return std::max(std::hypot(p.x(), p.y()) - cylinder->radius,
                    std::abs(p.z()) - cylinder->halfLength);
  if (const auto* capsule = std::get_if<Capsule>(&posed.shape)) {
    const double end = capsule->halfLength;
    return std::hypot(p.x(), p.y(), p.z() - std::clamp(p.z(), -end, end)) - capsule->radius;
  }
  double most = -std::numeric_limits<double>::infinity();
  for (const Corners& t : surfaceOf(posed.shape)) {
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (normal.norm() > 0.0) most = std::max(most, normal.normalized().dot(p - t[0]));
  }
  return most;
}

/// Triangles of a link's surface that are in no shape of its model, a little in front of it.
class OutsideParts {
 public:
  OutsideParts(const Link& link, const std::vector<PosedShape>& shapes) : shapes_(shapes) {
    Eigen::AlignedBox3d box;
    std::vector<Corners> all;
    for (const CollisionGeometry& geometry : link.collision)
      for (Corners corners : surfaceOf(geometry.shape)) {
        for (Vector3d& corner : corners) {
          corner = geometry.link_from_shape * corner;
          box.extend(corner);
        }
        all.push_back(corners);
      }
    size_ = box.isEmpty() ? 0.0 : box.diagonal().norm();
    for (const Corners& corners : all) add(corners);
  }

  /// None: nothing is outside.
  std::optional<TriangleMesh> mesh() const {
    if (vertices_.empty()) return {};
    return TriangleMesh::build(vertices_, triangles_, MeshInterior::Surface);
  }

 private:
  void add(const Corners& t) {
    const auto isIn = [&](const PosedShape& shape) {
      return std::ranges::all_of(
          t, [&](const Vector3d& corner) { return inFrontOf(shape, corner) <= 0.0; });
    };
    if (std::ranges::any_of(shapes_, isIn)) return;
    std::size_t longest = 0;
    const auto length = [&](std::size_t i) { return (t[i] - t[(i + 1) % 3]).norm(); };
    for (std::size_t i = 1; i < 3; ++i)
      if (length(i) > length(longest)) longest = i;
    if (length(longest) > kFineness * size_ && triangles_.size() < kMostTriangles) {
      Corners first = t;
      Corners second = t;
      first[longest] = second[(longest + 1) % 3] = 0.5 * (t[longest] + t[(longest + 1) % 3]);
      add(first);
      return add(second);
    }
    const Vector3d middle = (t[0] + t[1] + t[2]) / 3.0;
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (!(normal.norm() > 0.0)) return;
    for (const PosedShape& shape : shapes_)
      if (inFrontOf(shape, middle) <= 0.0) return;
    const auto index = static_cast<int>(vertices_.size());
    for (const Vector3d& corner : t)
      vertices_.emplace_back(corner + 2e-3 * size_ * normal.normalized());
    triangles_.emplace_back(index, index + 1, index + 2);
  }

  static constexpr double kFineness = 0.01;  // of the link
  static constexpr std::size_t kMostTriangles = 30000;
  const std::vector<PosedShape>& shapes_;
  double size_ = 0.0;  ///< m
  std::vector<Vector3d> vertices_;
  std::vector<Eigen::Vector3i> triangles_;
};

std::string excessText(const LinkSphereReport& report) {
  if (report.spheres == 0) return "without a model";
  if (report.outside.upper <= 0.0) return "contained: proven";
  return "outside by " + clearanceText(report.outside.lower) + " to " +
         clearanceText(report.outside.upper);
}

void addDrawingsOf(const Robot& robot, int index, const ShapeModel& model,
                   const LinkSphereReport& report, PageContent& content) {
  const Link& link = robot.links()[static_cast<std::size_t>(index)];
  const LinkShapes* own = model.find(link.name);
  const std::vector<PosedShape> none;
  const std::vector<PosedShape>& shapes = own == nullptr ? none : own->shapes;
  if (!shapes.empty()) {
    PageContent::Drawing drawing{.name = link.name + ": model",
                                 .link = index,
                                 .shapes = {},
                                 .colour = kModelColour,
                                 .opacity = 0.35};
    for (const PosedShape& posed : shapes)
      drawing.shapes.emplace_back(posed.shape, posed.body_from_shape);
    content.drawings.push_back(std::move(drawing));
  }
  if (report.outside.upper <= 0.0) return;
  if (const std::optional<TriangleMesh> mesh = OutsideParts(link, shapes).mesh())
    content.drawings.push_back({.name = link.name + ": outside",
                                .link = index,
                                .shapes = {{*mesh, Isometry3d::Identity()}},
                                .colour = kOutsideColour});
}

}  // namespace

void writeCoverPage(const Arguments& args, const Model& model, const Robot& robot,
                    const ShapeModel& shapes, const std::vector<LinkSphereReport>& reports) {
  if (args.page.file.empty()) return;
  PageContent content;
  content.tone = PageContent::Tone::Good;
  std::size_t outside = 0;
  for (const LinkSphereReport& report : reports) {
    if (report.outside.lower > 0.0) {
      ++outside;
      content.tone = PageContent::Tone::Bad;
    } else if (report.outside.upper > 0.0 && content.tone == PageContent::Tone::Good) {
      content.tone = PageContent::Tone::Unsure;
    }
    content.facts.emplace_back(report.link, std::to_string(report.spheres) + ", " +
                                                excessText(report) + ", largest excess " +
                                                clearanceText(report.excess.largest));
    addDrawingsOf(robot, robot.findLink(report.link).value_or(0), shapes, report, content);
  }
  content.headline = outside > 0 ? std::to_string(outside) + " of " +
                                       std::to_string(reports.size()) + " links partly outside"
                     : content.tone == PageContent::Tone::Good
                         ? "all links are contained"
                         : "it is not known whether all links are contained";
  const Group& group = robot.groups().front();
  PageContent::State state{.label = "default state", .q = {}};
  const Eigen::VectorXd all = robot.defaultState();
  for (const int variable : group.variables) state.q.push_back(all[variable]);
  content.states = {std::move(state)};
  writePage(args, model, nullptr, std::move(content));
}

}  // namespace swept
