// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "../ompl_bridge/rigid_bodies.hpp"
#include "mesh_files.hpp"

/// Planning for one rigid body among others: the problems, as OMPL.app keeps them, and one of our
/// own.
namespace swept::benchmark {

using test::BlockGrid;
using test::blockMesh;

/// All lengths in one unit.
struct RigidProblem {
  std::string name;
  Soup environment;
  Soup body;  ///< about the point that the body's position is of
  /// x, y, z and quaternion x, y, z, w: as a floating joint has them.
  std::vector<double> start, goal;
  Eigen::Vector3d lower, upper;  ///< of the body's position
};

/// `key = value` lines; sections do not matter, as no key is in two.
inline std::map<std::string, std::string> readPairs(const std::filesystem::path& file) {
  const auto trimmed = [](const std::string& text) {
    const auto begin = text.find_first_not_of(" \t\r");
    return begin == std::string::npos
               ? std::string()
               : text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
  };
  std::ifstream stream = openFile(file);
  std::map<std::string, std::string> pairs;
  for (std::string line; std::getline(stream, line);) {
    const auto equals = line.find('=');
    if (equals != std::string::npos)
      pairs[trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
  }
  return pairs;
}

/// One of OMPL.app's `.cfg` files.
class RigidProblemFile {
 public:
  explicit RigidProblemFile(const std::filesystem::path& file)
      : name_(file.string()), pairs_(readPairs(file)) {}

  /// Position, then the rotation by an angle (rad) about an axis as a quaternion.
  std::vector<double> pose(const std::string& key) const {
    const Eigen::Vector3d p = vector(key), axis = vector(key + ".axis").normalized();
    const Eigen::Quaterniond q(Eigen::AngleAxisd(number(key + ".theta"), axis));
    return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
  }
  Eigen::Vector3d vector(const std::string& key) const {
    return {number(key + ".x"), number(key + ".y"), number(key + ".z")};
  }

 private:
  /// Throws std::runtime_error where there is none.
  double number(const std::string& key) const {
    const auto found = pairs_.find(key);
    if (found == pairs_.end()) throw std::runtime_error(name_ + ": no " + key);
    return std::stod(found->second);
  }

  std::string name_;
  std::map<std::string, std::string> pairs_;
};

/// Vertices of lines and points, too: they are part of what is drawn.
inline void appendMesh(const aiMesh& mesh, const Eigen::Matrix4d& file_from_node, Soup& soup) {
  const int first = static_cast<int>(soup.vertices.size());
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    soup.vertices.emplace_back((file_from_node * Eigen::Vector4d(v.x, v.y, v.z, 1.0)).head<3>());
  }
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;
    soup.triangles.emplace_back(first + static_cast<int>(face.mIndices[0]),
                                first + static_cast<int>(face.mIndices[1]),
                                first + static_cast<int>(face.mIndices[2]));
  }
}

inline void appendNode(const aiScene& scene, const aiNode& node,
                       const Eigen::Matrix4d& file_from_parent, Soup& soup) {
  using RowMajor4f = Eigen::Matrix<float, 4, 4, Eigen::RowMajor>;
  const Eigen::Matrix4d file_from_node =
      file_from_parent * Eigen::Map<const RowMajor4f>(&node.mTransformation.a1).cast<double>();
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    appendMesh(*scene.mMeshes[node.mMeshes[i]], file_from_node, soup);
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    appendNode(scene, *node.mChildren[i], file_from_node, soup);
}

/// With assimp's own idea of which way is up, which OMPL.app's positions go by.
inline Soup readCollada(const std::filesystem::path& file) {
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                           aiProcess_SortByPType);
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());
  Soup soup;
  appendNode(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity(), soup);
  return soup;
}

/// The bodies of cubicles and twistycool lie where they were drawn, and OMPL.app's positions are of
/// the mean of all vertices as assimp has them, each corner once for every normal it has: for
/// cubicles that is the start, and for the piano its goal, to the two decimals given. About it,
/// both ends and the solutions that come with the problems are free.
inline Soup aboutItsCentre(Soup soup) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : soup.vertices) sum += vertex;
  const Eigen::Vector3d centre = sum / static_cast<double>(soup.vertices.size());
  for (Eigen::Vector3d& vertex : soup.vertices) vertex -= centre;
  return soup;
}

/// An L with legs of 0.6 m, and a wall with a square hole of 0.5 m: one leg has to go first. The
/// wall reaches too far to pass it on the outside.
inline RigidProblem throughAHole() {
  RigidProblem problem;
  problem.name = "L";
  const double far = 2.0;
  const BlockGrid l{{{{-0.3, -0.15, 0.3}, {-0.3, -0.15, 0.3}, {-0.075, 0.075}}},
                    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  BlockGrid wall{{{{-0.05, 0.05}, {-far, -0.25, 0.25, far}, {-far, -0.25, 0.25, far}}}, {}};
  for (std::size_t y = 0; y < 3; ++y)
    for (std::size_t z = 0; z < 3; ++z)
      if (y != 1 || z != 1) wall.blocks.push_back({0, y, z});
  problem.body = blockMesh<Soup>(l);
  problem.environment = blockMesh<Soup>(wall);
  problem.start = {-0.8, 0.4, -0.3, 0.0, 0.0, 0.0, 1.0};
  problem.goal = {0.8, -0.4, 0.3, 0.0, 0.0, 0.0, 1.0};
  problem.lower = Eigen::Vector3d::Constant(-1.0);
  problem.upper = Eigen::Vector3d::Constant(1.0);
  return problem;
}

/// All lengths times `factor`.
inline RigidProblem scaled(RigidProblem problem, double factor) {
  for (Soup* soup : {&problem.environment, &problem.body})
    for (Eigen::Vector3d& vertex : soup->vertices) vertex *= factor;
  for (std::size_t i = 0; i < 3; ++i) {
    problem.start[i] *= factor;
    problem.goal[i] *= factor;
  }
  problem.lower *= factor;
  problem.upper *= factor;
  return problem;
}

inline void readEnds(const std::filesystem::path& file, RigidProblem& problem) {
  const RigidProblemFile ends(file);
  problem.start = ends.pose("start");
  problem.goal = ends.pose("goal");
  problem.lower = ends.vector("volume.min");
  problem.upper = ends.vector("volume.max");
}

/// Those of OMPL.app in `folder`. Lengths are as in the files, which do not say so: SketchUp's
/// inches.
inline std::vector<RigidProblem> readRigidProblems(const std::filesystem::path& folder) {
  std::vector<RigidProblem> problems;
  const auto drawn = [&](const std::string& name, const std::string& stem, const std::string& cfg) {
    RigidProblem& problem = problems.emplace_back();
    problem.name = name;
    problem.environment = readCollada(folder / name / (stem + "_env.dae"));
    problem.body = aboutItsCentre(readCollada(folder / name / (stem + "_robot.dae")));
    readEnds(folder / name / cfg, problem);
  };
  drawn("cubicles", "cubicles", "cubicles.cfg");
  drawn("twistycool", "Twistycool", "Twistycool.cfg");
  const std::filesystem::path apartment = folder / "apartment_piano";
  for (const auto& [name, cfg] :
       {std::pair{"piano", "Apartment.cfg"}, std::pair{"piano_hard", "Apartment_hard.cfg"}}) {
    RigidProblem& problem = problems.emplace_back();
    problem.name = name;
    problem.environment = readObj(apartment / "apartment.obj");
    problem.body = readObj(apartment / "piano.obj");
    readEnds(apartment / cfg, problem);
  }
  return problems;
}

}  // namespace swept::benchmark
