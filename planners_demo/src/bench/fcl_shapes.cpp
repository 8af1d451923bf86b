// SPDX-License-Identifier: BSD-3-Clause
#include "bench/fcl_shapes.hpp"

#include <cmath>
#include <vector>

#include "command_line/exit_code.hpp"

namespace swept {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

Geometry meshOf(const std::vector<Eigen::Vector3d>& vertices,
                const std::vector<fcl::Triangle>& triangles) {
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

#if FCL_HAVE_OCTOMAP
/// Of cubes that a ball just contains.
Geometry octreeOf(const PointCloud& cloud) {
  const auto map = std::make_shared<octomap::OcTree>(2.0 * cloud.largestRadius() / std::sqrt(3.0));
  for (const Eigen::Vector3d& p : cloud.points()) map->updateNode(p.x(), p.y(), p.z(), true, true);
  map->updateInnerOccupancy();
  map->prune();
  return std::make_shared<fcl::OcTreed>(map);
}
#else
Geometry octreeOf(const PointCloud&) {
  throw UsageError("--against fcl: this FCL has no octrees, which stand for clouds");
}
#endif

struct Converter {
  const std::string& body;

  Geometry operator()(const Sphere& s) const { return std::make_shared<fcl::Sphered>(s.radius); }
  Geometry operator()(const Box& b) const {
    return std::make_shared<fcl::Boxd>(fcl::Vector3d(2.0 * b.halfExtents));
  }
  Geometry operator()(const Cylinder& c) const {
    return std::make_shared<fcl::Cylinderd>(c.radius, 2.0 * c.halfLength);
  }
  Geometry operator()(const Capsule& c) const {
    return std::make_shared<fcl::Capsuled>(c.radius, 2.0 * c.halfLength);
  }
  Geometry operator()(const Cone& c) const {
    return std::make_shared<fcl::Coned>(c.radius, 2.0 * c.halfLength);
  }
  Geometry operator()(const Ellipsoid& e) const {
    return std::make_shared<fcl::Ellipsoidd>(fcl::Vector3d(e.semiAxes));
  }
  Geometry operator()(const Plane& p) const {
    return std::make_shared<fcl::Planed>(p.normal, p.offset);
  }
  Geometry operator()(const HalfSpace& h) const {
    return std::make_shared<fcl::Halfspaced>(h.normal, h.offset);
  }
  Geometry operator()(const Triangle& t) const {
    return meshOf({t.corners.begin(), t.corners.end()}, {fcl::Triangle(0, 1, 2)});
  }
  Geometry operator()(const ConvexHull& hull) const {
    // Its own faces, each after its number of corners.
    auto faces = std::make_shared<std::vector<int>>();
    for (const Eigen::Vector3i& face : hull.faces())
      faces->insert(faces->end(), {3, face[0], face[1], face[2]});
    return std::make_shared<fcl::Convexd>(
        std::make_shared<const std::vector<Eigen::Vector3d>>(hull.vertices()),
        static_cast<int>(hull.faces().size()), faces);
  }
  Geometry operator()(const TriangleMesh& mesh) const {
    std::vector<fcl::Triangle> triangles;
    for (const TriangleMesh::Triangle& t : mesh.triangles())
      triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                             static_cast<std::size_t>(t[2]));
    return meshOf(mesh.vertices(), triangles);
  }
  Geometry operator()(const PointCloud& cloud) const {
    if (cloud.leastRadius() < cloud.largestRadius() || !(cloud.largestRadius() > 0.0))
      throw UsageError("--against fcl: the balls of '" + body +
                       "' are not all of one size above zero, as the cubes of FCL's octree are");
    return octreeOf(cloud);
  }
};

}  // namespace

Geometry fclGeometry(const Shape& shape, const std::string& body) {
  Geometry geometry = std::visit(Converter{body}, shape);
  geometry->computeLocalAABB();
  return geometry;
}

}  // namespace swept
