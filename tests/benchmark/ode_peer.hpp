// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef SWEPT_HAS_ODE
#include <ode/ode.h>

#include <cstdarg>
#include <memory>
#include <variant>
#include <vector>

#include "swept/core/shapes.hpp"

/// ODE on the same inputs: a hash space of obstacles, asked link by link.
namespace swept::benchmark {

class OdeTriangles {
 public:
  explicit OdeTriangles(const TriangleMesh& mesh) : id_(dGeomTriMeshDataCreate()) {
    for (const Eigen::Vector3d& v : mesh.vertices())
      vertices_.insert(vertices_.end(), {v.x(), v.y(), v.z()});
    for (const TriangleMesh::Triangle& t : mesh.triangles())
      for (const int corner : t) indices_.push_back(static_cast<dTriIndex>(corner));
    dGeomTriMeshDataBuildDouble(id_, vertices_.data(), 3 * sizeof(double),
                                static_cast<int>(mesh.vertices().size()), indices_.data(),
                                static_cast<int>(indices_.size()), 3 * sizeof(dTriIndex));
  }
  ~OdeTriangles() { dGeomTriMeshDataDestroy(id_); }
  OdeTriangles(const OdeTriangles&) = delete;
  OdeTriangles& operator=(const OdeTriangles&) = delete;
  dTriMeshDataID id() const { return id_; }

 private:
  std::vector<double> vertices_;
  std::vector<dTriIndex> indices_;
  dTriMeshDataID id_;
};

inline void odePlace(dGeomID geom, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d& p = pose.translation();
  dGeomSetPosition(geom, p.x(), p.y(), p.z());
  dMatrix3 rotation = {};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation[4 * row + column] = pose(row, column);
  dGeomSetRotation(geom, rotation);
}

class OdeScene {
 public:
  OdeScene() : obstacles_(dHashSpaceCreate(nullptr)), links_(dSimpleSpaceCreate(nullptr)) {}
  ~OdeScene() {
    dSpaceDestroy(obstacles_);
    dSpaceDestroy(links_);
  }
  OdeScene(const OdeScene&) = delete;
  OdeScene& operator=(const OdeScene&) = delete;

  void addObstacle(const Shape& shape, const Eigen::Isometry3d& pose) {
    odePlace(add(obstacles_, shape), pose);
  }
  void addLink(const Shape& shape) { geoms_.push_back(add(links_, shape)); }

  bool collides(const std::vector<Eigen::Isometry3d>& poses) {
    for (std::size_t i = 0; i < geoms_.size(); ++i) odePlace(geoms_[i], poses[i]);
    bool hit = false;
    for (std::size_t i = 0; i < geoms_.size() && !hit; ++i)
      dSpaceCollide2(geoms_[i], reinterpret_cast<dGeomID>(obstacles_), &hit, onPair);
    return hit;
  }

 private:
  static void onPair(void* data, dGeomID a, dGeomID b) {
    bool& hit = *static_cast<bool*>(data);
    if (hit) return;  // ODE cannot end a query of a space early
    dContactGeom contact;
    hit = dCollide(a, b, 1 | CONTACTS_UNIMPORTANT, &contact, sizeof contact) > 0;
  }

  dGeomID add(dSpaceID space, const Shape& shape) {
    if (const auto* box = std::get_if<Box>(&shape)) {
      const Eigen::Vector3d size = 2.0 * box->halfExtents;
      return dCreateBox(space, size.x(), size.y(), size.z());
    }
    if (const auto* sphere = std::get_if<Sphere>(&shape))
      return dCreateSphere(space, sphere->radius);
    if (const auto* cylinder = std::get_if<Cylinder>(&shape))
      return dCreateCylinder(space, cylinder->radius, 2.0 * cylinder->halfLength);
    meshes_.push_back(std::make_unique<OdeTriangles>(std::get<TriangleMesh>(shape)));
    return dCreateTriMesh(space, meshes_.back()->id(), nullptr, nullptr, nullptr);
  }

  dSpaceID obstacles_, links_;
  std::vector<std::unique_ptr<OdeTriangles>> meshes_;
  std::vector<dGeomID> geoms_;
};

}  // namespace swept::benchmark
#endif
