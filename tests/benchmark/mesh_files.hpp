// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// Reading the optional data from outside the project.
namespace swept::benchmark {

/// Triangles before anything looked at them.
struct Soup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
};

inline std::ifstream openFile(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
  return stream;
}

inline nlohmann::json readJson(const std::filesystem::path& file) {
  std::ifstream stream = openFile(file);
  return nlohmann::json::parse(stream);
}

/// `v x y z` and `f a b c` lines, as the data has them; corners may be `a/t/n`.
inline Soup readObj(const std::filesystem::path& file) {
  std::ifstream stream = openFile(file);
  Soup soup;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "v") {
      double x = 0.0, y = 0.0, z = 0.0;
      words >> x >> y >> z;
      soup.vertices.emplace_back(x, y, z);
    } else if (key == "f") {
      Eigen::Vector3i triangle;
      for (int& corner : triangle) {
        std::string text;
        words >> text;
        corner = std::stoi(text) - 1;
      }
      soup.triangles.push_back(triangle);
    }
  }
  return soup;
}

/// `[x, y, z, qw, qx, qy, qz]`; the quaternion is normalised.
inline Eigen::Isometry3d readPose(const nlohmann::json& list) {
  std::vector<double> v = list.get<std::vector<double>>();
  if (v.size() != 7) throw std::runtime_error("a pose must hold 7 numbers");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(v[3], v[4], v[5], v[6]).normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return pose;
}

}  // namespace swept::benchmark
