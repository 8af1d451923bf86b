// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/continuous/deforming_mesh.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "continuous/deforming_data.hpp"
#include "continuous/deforming_refit.hpp"
#include "continuous/follow_corners.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

using detail::DeformingFrame;
using Eigen::Vector3d;

namespace {

void makeRoom(const detail::TreeOrder& order, DeformingFrame& frame) {
  frame.vertices.resize(order.vertexOf.size());
  frame.corners.resize(order.blocks[0]);
  for (int level = 1; level < order.levels; ++level) {
    const auto l = static_cast<std::size_t>(level);
    frame.boxes[l].resize(order.blocks[l]);
  }
}

double finiteReach(std::span<const Vector3d> vertices) {
  const double reach = detail::largestCoordinate(vertices);
  if (!std::isfinite(reach)) throw std::invalid_argument("DeformingMesh: a vertex is not finite");
  return reach;
}

}  // namespace

double DeformingMesh::Data::follow(std::span<const Vector3d> vertices, double reach,
                                   DeformingFrame& frame) {
  copyVertices(vertices, 0, frame.vertices.size(), frame);
  frame.reach = reach;
  for (std::size_t s = 0; s < areas.size(); ++s)
    areas[s] = detail::followSubtree(order, points, s, frame);
  return finish(frame);
}

void DeformingMesh::Data::copyVertices(std::span<const Vector3d> vertices, std::size_t first,
                                       std::size_t last, DeformingFrame& frame) {
  for (std::size_t v = first; v < last; ++v) {
    const Vector3d& p = vertices[static_cast<std::size_t>(order.vertexOf[v])];
    frame.vertices[v] = p;
    points[v] = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
                 0.0F};
  }
}

double DeformingMesh::Data::finish(DeformingFrame& frame) {
  detail::BoxAreas sum;
  for (const detail::BoxAreas& part : areas) {
    sum.triangles += part.triangles;
    sum.nodes += part.nodes;
  }
  sum.nodes += detail::followTop(order, frame);
  // Not for triangles without an area, or beyond single precision: their boxes do not grow.
  const double ratio = sum.nodes / sum.triangles;
  return std::isfinite(ratio) ? ratio : 0.0;
}

void DeformingMesh::Data::arrange(std::span<const Vector3d> vertices) {
  order =
      detail::arrangeTriangles(vertices, surface.triangles(), surface.pieces(), surface.marks());
  points.resize(order.vertexOf.size());
  areas.resize(detail::subtrees(order));
  makeRoom(order, start);
  makeRoom(order, end);
}

/// Both frames in the order of a new tree, which is built for the end.
void DeformingMesh::Data::arrangeAnew() {
  std::vector<Vector3d> first(vertexCount, Vector3d::Zero());
  std::vector<Vector3d> last(vertexCount, Vector3d::Zero());
  for (std::size_t v = 0; v < order.vertexOf.size(); ++v) {
    const auto number = static_cast<std::size_t>(order.vertexOf[v]);
    first[number] = start.vertices[v];
    last[number] = end.vertices[v];
  }
  arrange(last);
  follow(first, start.reach, start);
  areaRatio = builtRatio = follow(last, end.reach, end);
}

DeformingMesh::DeformingMesh(std::unique_ptr<Data> data) : data_(std::move(data)) {}
DeformingMesh::DeformingMesh(const DeformingMesh& other)
    : data_(std::make_unique<Data>(*other.data_)) {}
DeformingMesh::DeformingMesh(DeformingMesh&&) noexcept = default;
DeformingMesh& DeformingMesh::operator=(const DeformingMesh& other) {
  if (this != &other) data_ = std::make_unique<Data>(*other.data_);
  return *this;
}
DeformingMesh& DeformingMesh::operator=(DeformingMesh&&) noexcept = default;
DeformingMesh::~DeformingMesh() = default;

DeformingMesh DeformingMesh::build(std::span<const Vector3d> vertices,
                                   std::span<const Triangle> triangles) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, vertices, triangles] { return build(vertices, triangles); });
  }
  if (triangles.empty()) throw std::invalid_argument("DeformingMesh: no triangles");
  for (const Triangle& t : triangles) {
    if (t.minCoeff() < 0 || static_cast<std::size_t>(t.maxCoeff()) >= vertices.size())
      throw std::invalid_argument("DeformingMesh: a triangle names a vertex that is not there");
  }
  const double reach = finiteReach(vertices);
  auto data = std::make_unique<Data>(vertices.size(), triangles);
  data->arrange(vertices);
  data->areaRatio = data->builtRatio = data->follow(vertices, reach, data->end);
  return DeformingMesh(std::move(data));
}

void DeformingMesh::moveTo(std::span<const Vector3d> vertices, unsigned threads) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, vertices, threads] { return moveTo(vertices, threads); });
  }
  Data& data = *data_;
  if (vertices.size() != data.vertexCount)
    throw std::invalid_argument("DeformingMesh: another number of vertices");
  data.areaRatio = detail::refit(data, vertices, detail::usefulThreads(threads, triangleCount()));
  std::swap(data.start, data.end);
  data.still = false;
  if (growth() >= kRebuildGrowth) rebuild();
}

void DeformingMesh::place(std::span<const Vector3d> vertices, unsigned threads) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, vertices, threads] { return place(vertices, threads); });
  }
  moveTo(vertices, threads);
  data_->still = true;
}

void DeformingMesh::rebuild() {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return rebuild(); });
  }
  data_->arrangeAnew();
  ++data_->rebuilds;
}

std::size_t DeformingMesh::vertexCount() const {
  return data_->vertexCount;
}
std::size_t DeformingMesh::triangleCount() const {
  return data_->order.triangleOf.size();
}
std::size_t DeformingMesh::rebuilds() const {
  return data_->rebuilds;
}
double DeformingMesh::growth() const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return growth(); });
  }
  if (data_->builtRatio > 0.0) return data_->areaRatio / data_->builtRatio;
  // It was built from points, so it has no order.
  return data_->areaRatio > 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
}

}  // namespace swept
