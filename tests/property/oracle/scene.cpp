// SPDX-License-Identifier: BSD-3-Clause
#include "scene.hpp"

#include <yaml-cpp/yaml.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace oracle {
namespace {

/// Numbers written as a list or as a map with the given keys.
template <size_t N>
std::array<double, N> values(const YAML::Node& node, const std::array<const char*, N>& keys) {
  std::array<double, N> v;
  for (size_t i = 0; i < N; ++i)
    v[i] = (node.IsMap() ? node[keys[i]] : node[i]).template as<double>();
  return v;
}

Isometry3d pose(const std::array<double, 3>& p, const std::array<double, 4>& xyzw) {
  Isometry3d result = Isometry3d::Identity();
  result.linear() =
      Eigen::Quaterniond(xyzw[3], xyzw[0], xyzw[1], xyzw[2]).normalized().toRotationMatrix();
  result.translation() = Vector3d(p[0], p[1], p[2]);
  return result;
}

Isometry3d pose(const YAML::Node& node) {
  std::array<double, 3> p{0, 0, 0};
  std::array<double, 4> q{0, 0, 0, 1};
  if (node && node["position"]) p = values<3>(node["position"], {"x", "y", "z"});
  if (node && node["orientation"]) q = values<4>(node["orientation"], {"x", "y", "z", "w"});
  return pose(p, q);
}

/// MoveIt's ways: a box has full sizes, a cylinder [height, radius].
Primitive primitive(const YAML::Node& node) {
  const auto type = node["type"].as<std::string>();
  const auto d = node["dimensions"].as<std::vector<double>>();
  if (type == "box" || type == "1") return Box{Vector3d(d.at(0), d.at(1), d.at(2)) / 2};
  if (type == "sphere" || type == "2") return Sphere{d.at(0)};
  if (type == "cylinder" || type == "3") return Cylinder{d.at(1), d.at(0) / 2};
  throw std::runtime_error("unknown primitive " + type);
}

std::shared_ptr<const Mesh> mesh(const YAML::Node& node, const std::filesystem::path& folder) {
  if (node["resource"]) {
    std::array<double, 3> scale{1, 1, 1};
    if (node["dimensions"]) scale = values<3>(node["dimensions"], {"x", "y", "z"});
    return std::make_shared<Mesh>(Mesh::read(folder / node["resource"].as<std::string>(),
                                             Vector3d(scale[0], scale[1], scale[2])));
  }
  std::vector<Vector3d> vertices;
  for (const auto& v : node["vertices"]) {
    const auto p = values<3>(v, {"x", "y", "z"});
    vertices.emplace_back(p[0], p[1], p[2]);
  }
  std::vector<std::array<int, 3>> faces;
  for (const auto& t : node["triangles"])
    faces.push_back((t.IsMap() ? t["vertex_indices"] : t).as<std::array<int, 3>>());
  return std::make_shared<Mesh>(vertices, faces);
}

}  // namespace

std::vector<Body> readScene(const std::filesystem::path& file) {
  const YAML::Node root = YAML::LoadFile(file.string());
  const YAML::Node world = root["world"] ? root["world"] : root;
  std::vector<Body> bodies;
  for (const auto& object : world["collision_objects"]) {
    Body body{object["id"].as<std::string>(), {}};
    const Isometry3d model_from_object = pose(object["pose"]);
    auto place = [&](Piece piece, const YAML::Node& at) {
      piece.body_from_piece = model_from_object * pose(at);
      body.pieces.push_back(std::move(piece));
    };
    const size_t primitives = object["primitives"] ? object["primitives"].size() : 0;
    const size_t meshes = object["meshes"] ? object["meshes"].size() : 0;
    for (size_t i = 0; i < primitives; ++i)
      place(Piece(primitive(object["primitives"][i])), object["primitive_poses"][i]);
    for (size_t i = 0; i < meshes; ++i)
      place(Piece(mesh(object["meshes"][i], file.parent_path())), object["mesh_poses"][i]);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

Problem readProblem(const std::filesystem::path& file, const std::string& set, int index) {
  std::ifstream in(file);
  const auto sets = nlohmann::json::parse(in);
  for (const auto& p : sets.at(set)) {
    if (p.at("index") != index) continue;
    Problem problem;
    auto add = [&](const nlohmann::json& e, const Primitive& solid) {
      Piece piece(solid);
      piece.body_from_piece = pose(e.at("position").get<std::array<double, 3>>(),
                                   e.value("orientation", std::array<double, 4>{0, 0, 0, 1}));
      problem.world.push_back({e.at("name"), {piece}});
    };
    for (const auto& e : p.at("world").at("sphere")) add(e, Sphere{e.at("radius")});
    for (const auto& e : p.at("world").at("cylinder"))
      add(e, Cylinder{e.at("radius"), e.at("length").get<double>() / 2});
    for (const auto& e : p.at("world").at("box")) {
      const auto h = e.at("half_extents").get<std::array<double, 3>>();
      add(e, Box{Vector3d(h[0], h[1], h[2])});
    }
    problem.joints = p.at("joint_names").get<std::vector<std::string>>();
    problem.start = p.at("start").get<std::vector<double>>();
    problem.goal = p.at("goals").at(0).get<std::vector<double>>();
    return problem;
  }
  throw std::runtime_error("no problem " + std::to_string(index) + " in " + set);
}

std::vector<int> problemIndices(const std::filesystem::path& file, const std::string& set) {
  std::ifstream in(file);
  const auto sets = nlohmann::json::parse(in);
  std::vector<int> indices;
  for (const auto& p : sets.at(set)) indices.push_back(p.at("index"));
  return indices;
}

}  // namespace oracle
