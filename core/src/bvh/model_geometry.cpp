// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/bvh/model_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <utility>

#include "geometry/point_text.hpp"

namespace swept {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

std::string stateMessage(std::string_view call, BvhState state,
                         std::initializer_list<BvhState> allowed) {
  std::ostringstream message;
  message << "BvhModel::" << call << ": model is " << toString(state) << "; allowed: ";
  const char* separator = "";
  for (const BvhState each : allowed) {
    message << separator << toString(each);
    separator = " or ";
  }
  return message.str();
}

[[noreturn]] void refuse(std::string_view call, const std::string& what) {
  throw std::invalid_argument("BvhModel::" + std::string(call) + ": " + what);
}

/// Appends `made` of each element. The old memory stays until the end: the elements may be in it.
template <typename Item, typename Make>
void appendTo(std::vector<Item>& to, std::span<const Item> items, const Make& made) {
  if (to.capacity() - to.size() >= items.size()) {
    for (std::size_t i = 0; i < items.size(); ++i) to.push_back(made(items[i]));
    return;
  }
  std::vector<Item> longer;
  longer.reserve(std::max(to.size() + items.size(), 2 * to.capacity()));
  longer.assign(to.begin(), to.end());
  for (const Item& item : items) longer.push_back(made(item));
  to = std::move(longer);
}

}  // namespace

std::string_view toString(BvhState state) {
  switch (state) {
    case BvhState::Empty:
      return "empty";
    case BvhState::Building:
      return "building";
    case BvhState::Built:
      return "built";
    case BvhState::Replacing:
      return "replacing";
    case BvhState::Updating:
      return "updating";
    case BvhState::Updated:
      return "updated";
  }
  return "unknown";
}

BvhStateError::BvhStateError(std::string_view call, BvhState state,
                             std::initializer_list<BvhState> allowed)
    : std::logic_error(stateMessage(call, state, allowed)) {}

void ModelGeometry::requireState(std::string_view call,
                                 std::initializer_list<BvhState> allowed) const {
  if (std::find(allowed.begin(), allowed.end(), state_) == allowed.end()) {
    throw BvhStateError(call, state_, allowed);
  }
}

void ModelGeometry::requireUsable(std::string_view call) const {
  requireState(call, {BvhState::Built, BvhState::Updated});
}

void ModelGeometry::requireTriangles(std::string_view call) const {
  requireUsable(call);
  if (isPointCloud()) refuse(call, "model is a point cloud; allowed: triangles");
}

void ModelGeometry::requireFinite(std::string_view call, std::size_t index,
                                  const Vector3d& p) const {
  if (p.allFinite()) return;
  refuse(call,
         "vertex " + std::to_string(index) + " is " + detail::pointText(p) + "; allowed: finite");
}

void ModelGeometry::requireVertices(std::string_view call, const Vector3i& triangle,
                                    std::size_t index, std::size_t count) const {
  for (const int vertex : triangle) {
    if (vertex >= 0 && static_cast<std::size_t>(vertex) < count) continue;
    refuse(call, "triangle " + std::to_string(index) + " has vertex " + std::to_string(vertex) +
                     "; allowed: 0 to " + std::to_string(count) + " exclusive");
  }
}

void ModelGeometry::requirePrimitives() const {
  if (vertices_.empty()) refuse("end", "no triangles and no points");
  const auto ball = std::find_if(radii_.begin(), radii_.end(), [](double r) { return r > 0.0; });
  if (triangles_.empty() || ball == radii_.end()) return;
  std::ostringstream message;
  message << "point " << ball - radii_.begin() << " has radius " << *ball
          << " in a model of triangles; allowed: 0";
  refuse("end", message.str());
}

void ModelGeometry::giveRadii() {
  if (!radii_.empty()) radii_.resize(vertices_.size(), 0.0);
}

void ModelGeometry::begin(std::size_t expectedVertices, std::size_t expectedTriangles) {
  requireState("begin", {BvhState::Empty});
  vertices_.reserve(expectedVertices);
  triangles_.reserve(expectedTriangles);
  state_ = BvhState::Building;
}

int ModelGeometry::addVertex(const Vector3d& position) {
  requireState("addVertex", {BvhState::Building});
  requireFinite("addVertex", vertices_.size(), position);
  vertices_.push_back(position);
  giveRadii();
  return static_cast<int>(vertices_.size()) - 1;
}

int ModelGeometry::addTriangle(const Vector3i& vertices) {
  requireState("addTriangle", {BvhState::Building});
  requireVertices("addTriangle", vertices, triangles_.size(), vertices_.size());
  triangles_.push_back(vertices);
  return static_cast<int>(triangles_.size()) - 1;
}

int ModelGeometry::addTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  requireState("addTriangle", {BvhState::Building});
  const auto first = static_cast<int>(vertices_.size());
  requireFinite("addTriangle", vertices_.size(), a);
  requireFinite("addTriangle", vertices_.size() + 1, b);
  requireFinite("addTriangle", vertices_.size() + 2, c);
  vertices_.insert(vertices_.end(), {a, b, c});
  giveRadii();
  triangles_.emplace_back(first, first + 1, first + 2);
  return static_cast<int>(triangles_.size()) - 1;
}

int ModelGeometry::addMesh(std::span<const Vector3d> vertices,
                           std::span<const Vector3i> triangles) {
  requireState("addMesh", {BvhState::Building});
  for (std::size_t i = 0; i < vertices.size(); ++i) requireFinite("addMesh", i, vertices[i]);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    requireVertices("addMesh", triangles[i], i, vertices.size());
  }
  const auto firstVertex = static_cast<int>(vertices_.size());
  const auto firstTriangle = static_cast<int>(triangles_.size());
  appendTo(vertices_, vertices, [](const Vector3d& v) { return v; });
  giveRadii();
  appendTo(triangles_, triangles,
           [=](const Vector3i& t) { return Vector3i(t.array() + firstVertex); });
  return firstTriangle;
}

int ModelGeometry::addPoint(const Vector3d& position, double radius) {
  requireState("addPoint", {BvhState::Building});
  requireFinite("addPoint", vertices_.size(), position);
  if (!(radius >= 0.0) || !std::isfinite(radius)) {
    std::ostringstream what;
    what << "point " << vertices_.size() << " has radius " << radius
         << "; allowed: finite and not negative";
    refuse("addPoint", what.str());
  }
  vertices_.push_back(position);
  radii_.resize(vertices_.size(), 0.0);
  radii_.back() = radius;
  return static_cast<int>(vertices_.size()) - 1;
}

void ModelGeometry::beginReplace() {
  requireState("beginReplace", {BvhState::Built, BvhState::Updated});
  previous_.clear();
  state_ = BvhState::Replacing;
}

void ModelGeometry::beginUpdate() {
  requireState("beginUpdate", {BvhState::Built, BvhState::Updated});
  previous_ = vertices_;
  state_ = BvhState::Updating;
}

void ModelGeometry::replaceVertices(std::size_t first, std::span<const Vector3d> positions) {
  requireState("replaceVertices", {BvhState::Replacing});
  overwrite("replaceVertices", first, positions);
}

void ModelGeometry::updateVertices(std::size_t first, std::span<const Vector3d> positions) {
  requireState("updateVertices", {BvhState::Updating});
  overwrite("updateVertices", first, positions);
}

void ModelGeometry::overwrite(std::string_view call, std::size_t first,
                              std::span<const Vector3d> positions) {
  if (first > vertices_.size() || positions.size() > vertices_.size() - first) {
    refuse(call, "vertices " + std::to_string(first) + " and " + std::to_string(positions.size()) +
                     " on of " + std::to_string(vertices_.size()) + "; allowed: those there are");
  }
  for (std::size_t i = 0; i < positions.size(); ++i) requireFinite(call, first + i, positions[i]);
  const auto to = vertices_.begin() + static_cast<std::ptrdiff_t>(first);
  // If the new positions are our own vertices, they are read from the end, before they are
  // overwritten.
  const bool isBefore = std::less<>()(positions.data(), vertices_.data() + first);
  if (isBefore)
    std::copy_backward(positions.begin(), positions.end(),
                       to + static_cast<std::ptrdiff_t>(positions.size()));
  else
    std::copy(positions.begin(), positions.end(), to);
}

std::size_t ModelGeometry::pointsPerPrimitive() const {
  const std::size_t corners = isPointCloud() ? 1 : 3;
  return previous_.empty() ? corners : 2 * corners;
}

std::vector<Vector3d> ModelGeometry::primitivePoints() const {
  std::vector<Vector3d> points;
  points.reserve(primitiveCount() * pointsPerPrimitive());
  if (isPointCloud()) {
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      points.push_back(vertices_[i]);
      if (!previous_.empty()) points.push_back(previous_[i]);
    }
  }
  for (const Vector3i& t : triangles_) {
    for (const int vertex : t) points.push_back(vertices_[vertex]);
    if (previous_.empty()) continue;
    for (const int vertex : t) points.push_back(previous_[vertex]);
  }
  return points;
}

void ModelGeometry::enter(BvhState state) {
  extent_ = 0.0;
  for (const Vector3d& v : vertices_) extent_ = std::max(extent_, v.lpNorm<1>());
  state_ = state;
}

void ModelGeometry::clearGeometry() {
  vertices_.clear();
  previous_.clear();
  triangles_.clear();
  radii_.clear();
  extent_ = 0.0;
  state_ = BvhState::Empty;
}

std::size_t ModelGeometry::geometryBytes() const {
  return (vertices_.capacity() + previous_.capacity()) * sizeof(Vector3d) +
         triangles_.capacity() * sizeof(Vector3i) + radii_.capacity() * sizeof(double);
}

}  // namespace swept
