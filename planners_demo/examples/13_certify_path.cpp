// SPDX-License-Identifier: BSD-3-Clause
// A path from another planner: is it free? Writes the proof to a file that anybody can check. Needs
// no OMPL.
//   example_13_certify_path MODELS
// Exits 0 if the path is proven, and the proof does not hold for a world with one more body.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "swept/proofs/path_proof.hpp"
#include "swept/robot_model/path_file.hpp"

/// From your own planner, or from ROS (.yaml): here as a table of its joints, in any order.
std::filesystem::path plannedPath() {
  const auto file = std::filesystem::temp_directory_path() / "swept_example_path.csv";
  std::ofstream(file) << "joint2,joint1,joint3,joint4,joint5,joint6,joint7\n"
                         "-0.5,-0.3,0,1.5,0,0.8,0\n"
                         "-0.5,0,0,1.5,0,0.8,0\n"
                         "-0.4,0.2,0,1.4,0,0.8,0.5\n";
  return file;
}

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::string arm = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  const auto world = std::make_shared<swept::World>();
  world->add(swept::WorldBody{.name = "post",
                              .parts = {{swept::makeCylinder(0.05, 1.0),
                                         Eigen::Isometry3d(Eigen::Translation3d(-1.2, 0, 0))}}});
  const swept::Checker checker(robot, "arm", world);
  const std::vector<std::vector<double>> path =
      swept::readPath(plannedPath(), *robot, checker.group());

  // Verdict and clearance of each segment, on all processors.
  const swept::PathCertificate certificate = swept::certifyPath(checker, path);
  std::cout << path.size() << " states, " << toString(certificate.verdict()) << '\n';
  if (certificate.verdict() != swept::Verdict::Free) return 1;

  // Planes that prove it, with robot and world: the file needs nothing else to be checked.
  const auto file = std::filesystem::temp_directory_path() / "swept_example_proof.json";
  const swept::WrittenProof written = swept::writeProof(file, checker, path, certificate);
  if (!written.isWritten()) return 1;
  const swept::CheckedProof proof = swept::verifyProof(file);
  std::cout << "proof holds: " << proof.planes << " planes, every pair keeps more than "
            << proof.clearance << " m\n";

  // The proof is about this world alone.
  const auto other = checker.withBody({.name = "shelf", .parts = world->bodies().front().parts});
  const swept::CheckedProof elsewhere = swept::verifyProof(file, other);
  std::cout << "in another world: " << elsewhere.refusal << '\n';
  return proof.holds() && proof.segments == 2 && !elsewhere.holds() ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
