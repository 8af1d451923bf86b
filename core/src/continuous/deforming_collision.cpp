// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "continuous/deforming_data.hpp"
#include "continuous/deforming_workspace.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept {

using detail::MeetingPair;

DeformingWorkspace::DeformingWorkspace() : data_(std::make_unique<Data>()) {}
DeformingWorkspace::DeformingWorkspace(DeformingWorkspace&&) noexcept = default;
DeformingWorkspace& DeformingWorkspace::operator=(DeformingWorkspace&&) noexcept = default;
DeformingWorkspace::~DeformingWorkspace() = default;

namespace {

using Mesh = DeformingMesh::Data;

TriangleCorners corners(const Mesh& mesh, const detail::DeformingFrame& frame, std::uint32_t slot) {
  const detail::VertexBlock& block = mesh.order.vertices[slot / detail::kTreeLanes];
  const std::size_t lane = slot % detail::kTreeLanes;
  const auto at = [&](std::size_t k) -> const Eigen::Vector3d& {
    return frame.vertices[static_cast<std::size_t>(block.of[k][lane])];
  };
  return {at(0), at(1), at(2)};
}

/// The caller's numbers.
TrianglePair named(const Mesh& a, const Mesh& b, const MeetingPair& pair) {
  const int first = a.order.triangleOf[pair.first];
  const int second = b.order.triangleOf[pair.second];
  if (&a == &b) return {std::min(first, second), std::max(first, second)};
  return {first, second};
}

void touching(const Mesh& a, const Mesh& b, const MeshCollisionOptions& options,
              MeshCollisionResult& result, DeformingWorkspace& workspace) {
  result.reset();
  auto& scratch = workspace.data();
  scratch.pairs.clear();
  const double reach = std::max(a.end.reach, b.end.reach);
  detail::findMeetingPairs({&a.order, nullptr, &a.end}, {&b.order, nullptr, &b.end}, &a == &b,
                           detail::meetingMargin(0.0, reach), scratch.open, scratch.pairs);
  for (const MeetingPair& pair : scratch.pairs) {
    if (result.touching && result.pairs.size() >= options.maxPairs) break;
    ++result.effort.leafTests;
    if (!trianglesTouch(corners(a, a.end, pair.first), corners(b, b.end, pair.second))) continue;
    result.touching = true;
    if (options.maxPairs > 0) result.pairs.push_back(named(a, b, pair));
  }
  std::sort(result.pairs.begin(), result.pairs.end());
}

}  // namespace

void selfCollide(const DeformingMesh& mesh, const MeshCollisionOptions& options,
                 MeshCollisionResult& result, DeformingWorkspace& workspace) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return selfCollide(mesh, options, result, workspace); });
  }
  touching(mesh.data(), mesh.data(), options, result, workspace);
}

void collide(const DeformingMesh& a, const DeformingMesh& b, const MeshCollisionOptions& options,
             MeshCollisionResult& result, DeformingWorkspace& workspace) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return collide(a, b, options, result, workspace); });
  }
  touching(a.data(), b.data(), options, result, workspace);
}

}  // namespace swept
