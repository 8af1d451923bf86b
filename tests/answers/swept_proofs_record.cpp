// SPDX-License-Identifier: BSD-3-Clause
/// Proofs of the stored planned paths (tests/regression/paths), written by one build to be checked
/// by another one; see README.md.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "models_dir.hpp"
#include "swept/proofs/path_proof.hpp"
#include "swept/robot_model/path_file.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path kModels = modelsDir();

std::vector<fs::path> filesOf(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ending) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// The file's name is ROBOT.SCENE.GROUP.PLANNER.NUMBER.csv. Returns the verdict, in words.
std::string prove(const fs::path& path, const fs::path& file) {
  std::istringstream name(path.filename().string());
  std::string robotName, scene, group;
  std::getline(name, robotName, '.');
  std::getline(name, scene, '.');
  std::getline(name, group, '.');
  const fs::path stem = kModels / "robots" / robotName / robotName;
  const auto robot = swept::Robot::load(stem.string() + ".urdf", stem.string() + ".srdf");
  const auto world = std::make_shared<const swept::World>(
      swept::World::load(kModels / "scenes" / (scene + ".yaml")));
  const swept::Checker checker(robot, group, world);
  const auto states = swept::readPath(path, *robot, checker.group());
  const swept::PathCertificate certificate = swept::certifyPath(checker, states);
  const std::string verdict(toString(certificate.verdict()));
  if (certificate.verdict() != swept::Verdict::Free) return verdict;
  const swept::WrittenProof written = swept::writeProof(file, checker, states, certificate);
  return written.isWritten() ? verdict : verdict + ", not proven: " + written.missing;
}

int write(const fs::path& folder, const std::string& which) {
  fs::create_directories(folder);
  int count = 0;
  for (const fs::path& path : filesOf(kModels.parent_path() / "tests/regression/paths", ".csv")) {
    const std::string name = path.stem().string();
    if (name == "verdicts" || !std::regex_search(name, std::regex(which))) continue;
    std::cout << name << ": " << prove(path, folder / (name + ".json")) << std::endl;
    ++count;
  }
  return count > 0 ? 0 : 3;
}

int verify(const fs::path& folder) {
  int held = 0, refused = 0;
  for (const fs::path& file : filesOf(folder, ".json")) {
    const swept::CheckedProof proof = swept::verifyProof(file);
    (proof.holds() ? held : refused) += 1;
    if (!proof.holds()) std::cout << file.stem().string() << ": " << proof.refusal << '\n';
  }
  std::cout << held << " proofs hold, " << refused << " do not\n";
  return refused > 0 || held == 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string command = argc > 2 ? argv[1] : "";
  if (command == "write") return write(argv[2], argc > 3 ? argv[3] : ".");
  if (command == "verify" && argc == 3) return verify(argv[2]);
  std::cerr << "usage: swept_proofs_record write FOLDER [REGEX] | verify FOLDER\n";
  return 3;
} catch (const std::exception& error) {
  std::cerr << "error: " << error.what() << '\n';
  return 3;
}
