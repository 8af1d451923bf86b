// SPDX-License-Identifier: BSD-3-Clause
#include "path_files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "text_output.hpp"

namespace swept {
namespace {

std::vector<std::string> variableNames(const Checker& checker) {
  std::vector<std::string> names;
  for (const int v : checker.group().variables)
    names.push_back(checker.robot().variables()[v].name);
  return names;
}

std::string jsonText(const Checker& checker, const PlanRequest& request,
                     const PlanOutcome& outcome) {
  Json json = {{"robot", checker.robot().name()},      {"group", checker.group().name},
               {"planner", request.planner},           {"seed", request.seed},
               {"margin", checker.options().margin},   {"tolerance", checker.options().tolerance},
               {"joint_names", variableNames(checker)}};
  json["states"] = Json::array();
  for (const std::vector<double>& q : outcome.states) json["states"].push_back(toJson(q));
  json["segments"] = Json::array();
  for (const PathSegment& segment : outcome.segments)
    json["segments"].push_back({{"verdict", toString(segment.certificate.verdict)},
                                {"clearance", finiteOrNull(segment.clearance)}});
  return json.dump(1) + "\n";
}

std::string csvText(const Checker& checker, const PlanOutcome& outcome) {
  std::string text = joined(variableNames(checker), ",") + "\n";
  for (const std::vector<double>& q : outcome.states) {
    for (std::size_t i = 0; i < q.size(); ++i)
      text.append(i == 0 ? "" : ",").append(exactNumber(q[i]));
    text += "\n";
  }
  return text;
}

/// A JSON string is a YAML string too, whatever characters the name has.
std::string quoted(const std::string& name) {
  return Json(name).dump();
}

/// moveit_msgs/RobotTrajectory. A path has no times, so the points have none either.
std::string yamlText(const Checker& checker, const PlanOutcome& outcome) {
  std::string text = "joint_trajectory:\n  joint_names:\n";
  for (const std::string& name : variableNames(checker)) text += "    - " + quoted(name) + "\n";
  text += "  points:\n";
  for (const std::vector<double>& q : outcome.states) {
    text += "    - positions: [";
    for (std::size_t i = 0; i < q.size(); ++i)
      text.append(i == 0 ? "" : ", ").append(exactNumber(q[i]));
    text += "]\n";
  }
  return text;
}

bool isYaml(const std::filesystem::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

void requireOneValuePerJoint(const std::filesystem::path& file, const Robot& robot,
                             const Group& group) {
  for (const int j : group.joints) {
    const JointType type = robot.joints()[j].type;
    if (type == JointType::Planar || type == JointType::Floating)
      throw UsageError("'" + file.string() +
                       "': a joint trajectory has one value per joint, and joint " +
                       robot.joints()[j].name + " has several; use .json or .csv");
  }
}

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw UsageError("cannot write '" + file.string() + "': " + std::strerror(error));
}

std::filesystem::path folderOf(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// Returns errno, or 0.
int writeAll(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    done += static_cast<std::size_t>(written);
  }
  return fsync(descriptor) == 0 ? 0 : errno;
}

/// Under a name of its own first: whoever reads the file sees the old one or the whole new one.
void writeWhole(const std::filesystem::path& file, const std::string& text) {
  std::string temporary = (folderOf(file) / ("." + file.filename().string() + ".XXXXXX")).string();
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) refuse(file, errno);
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(descriptor, 0666 & ~mask);
  int error = writeAll(descriptor, text);
  if (close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(temporary.c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) return;
  unlink(temporary.c_str());
  refuse(file, error);
}

}  // namespace

PathFile::PathFile(const std::string& file, const Robot& robot, const Group& group) : file_(file) {
  const std::filesystem::path ending = file_.extension();
  if (ending != ".json" && ending != ".csv" && !isYaml(file_))
    throw UsageError("'" + file + "': a path file ends in .json, .csv or .yaml");
  if (std::filesystem::is_directory(file_)) refuse(file_, EISDIR);
  if (const std::filesystem::path folder = folderOf(file_); !std::filesystem::is_directory(folder))
    refuse(file_, std::filesystem::exists(folder) ? ENOTDIR : ENOENT);
  if (access(folderOf(file_).c_str(), W_OK | X_OK) != 0) refuse(file_, errno);
  if (isYaml(file_)) requireOneValuePerJoint(file_, robot, group);
}

void PathFile::write(const Checker& checker, const PlanRequest& request,
                     const PlanOutcome& outcome) const {
  if (file_.extension() == ".json")
    writeWhole(file_, jsonText(checker, request, outcome));
  else if (file_.extension() == ".csv")
    writeWhole(file_, csvText(checker, outcome));
  else
    writeWhole(file_, yamlText(checker, outcome));
}

}  // namespace swept
