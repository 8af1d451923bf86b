// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "sphere_refuter.hpp"

/// Says for each link of a robot whether the spheres of a spherized URDF contain it:
/// `sphere_refute ROBOT.urdf SPHERES.urdf POINTS`, of the surface of each link. Exits with 1 for a
/// point outside, and for a surface or an inside that is not decided.
int main(int argc, char** argv) {
  using namespace swept::test;
  if (argc != 4) {
    std::cerr << "usage: sphere_refute ROBOT.urdf SPHERES.urdf POINTS\n";
    return 2;
  }
  constexpr double kError = 1e-9;  // m
  bool refuted = false;
  try {
    for (const auto& [name, link] : readRefuterLinks(argv[1], argv[2])) {
      if (link.triangles.empty()) continue;
      const double outside = sampledOutside(link, std::stoull(argv[3]), 1);
      const bool surface = surfaceIsContained(link, kError);
      const bool inside = insideIsContained(link, kError);
      std::cout << name << ": " << link.balls.size() << " spheres, farthest sample " << outside
                << " m, surface " << (surface ? "contained" : "NOT contained") << ", inside "
                << (inside ? "contained" : "NOT contained") << std::endl;
      refuted = refuted || outside > 0.0 || !surface || !inside;
    }
  } catch (const std::exception& error) {
    std::cerr << "sphere_refute: " << error.what() << '\n';
    return 2;
  }
  return refuted ? 1 : 0;
}
