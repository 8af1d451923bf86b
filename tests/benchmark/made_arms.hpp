// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "swept/robot_model/robot.hpp"
#include "workloads.hpp"

/// Serial arms of any number of joints, made on the spot.
namespace swept::benchmark {

/// Straight up at 0, joints about z and y in turn, 1.2 m long whatever the number of joints.
struct SerialArm {
  int joints = 7;

  double linkLength() const { return 1.2 / joints; }                        ///< m
  double linkRadius() const { return std::min(0.06, 0.3 * linkLength()); }  ///< m
  /// rad. With more joints each bends less, as those of snakes do: else they would mostly be knots.
  double limit() const { return 2.6 * std::sqrt(7.0 / joints); }

  /// Every other link a box, the others cylinders with a ball at the end.
  std::string urdf() const {
    return urdf([this](int link, std::ostringstream& out) {
      const double length = linkLength(), r = linkRadius();
      const std::string middle = origin(0.5 * length);
      if (link % 2 != 0) {
        out << "<collision>" << middle << "<geometry><box size='" << 1.8 * r << ' ' << 1.8 * r
            << ' ' << length << "'/></geometry></collision>\n";
        return;
      }
      out << "<collision>" << middle << "<geometry><cylinder radius='" << r << "' length='"
          << length << "'/></geometry></collision>\n<collision>" << origin(length)
          << "<geometry><sphere radius='" << 1.1 * r << "'/></geometry></collision>\n";
    });
  }

  /// `linkN.stl` for each link, beside the URDF.
  std::string urdfWithMeshes() const {
    return urdf([](int link, std::ostringstream& out) {
      out << "<collision><geometry><mesh filename='link" << link
          << ".stl'/></geometry></collision>\n";
    });
  }

  /// About `triangles`, closed: a capsule with bumps, as long as a link.
  Soup linkMesh(int triangles) const {
    const double r = linkRadius(), half = std::max(0.0, 0.5 * linkLength() - 0.5 * r);
    Soup soup = bumpySphere(triangles, 1.0);
    for (Eigen::Vector3d& v : soup.vertices) {
      const double shift = half * std::clamp(2.0 * v.z(), -1.0, 1.0);
      v = r * v + Eigen::Vector3d(0.0, 0.0, 0.5 * linkLength() + shift);
    }
    return soup;
  }

 private:
  static std::string origin(double z) { return "<origin xyz='0 0 " + std::to_string(z) + "'/>"; }

  template <typename Geometry>
  std::string urdf(const Geometry& geometryOf) const {
    std::ostringstream out;
    out << "<?xml version='1.0'?>\n<robot name='arm" << joints
        << "'>\n<link name='base'><collision>" << origin(-0.05)
        << "<geometry><cylinder radius='0.08' length='0.1'/></geometry>"
        << "</collision></link>\n";
    for (int i = 1; i <= joints; ++i) {
      out << "<link name='link" << i << "'>\n";
      geometryOf(i, out);
      out << "</link>\n<joint name='joint" << i << "' type='revolute'>"
          << origin(i == 1 ? 0.0 : linkLength()) << "<parent link='"
          << (i == 1 ? std::string("base") : "link" + std::to_string(i - 1))
          << "'/><child link='link" << i << "'/><axis xyz='" << (i % 2 != 0 ? "0 0 1" : "0 1 0")
          << "'/><limit lower='" << -limit() << "' upper='" << limit()
          << "' effort='1' velocity='1'/></joint>\n";
    }
    out << "</robot>\n";
    return out.str();
  }
};

/// Binary STL: what most URDFs come with.
inline void writeStl(const Soup& soup, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  const std::string header(80, ' ');
  out.write(header.data(), 80);
  const auto put = [&](auto value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(soup.triangles.size()));
  for (const Eigen::Vector3i& triangle : soup.triangles) {
    for (int i = 0; i < 3; ++i) put(0.0F);  // no normal: readers make their own
    for (const int corner : triangle)
      for (const double x : soup.vertices[static_cast<std::size_t>(corner)])
        put(static_cast<float>(x));
    put(std::uint16_t{0});
  }
}

}  // namespace swept::benchmark
