// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <stdexcept>
#include <vector>

#include "fuzz_input.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/trajectory_file.hpp"
#include "swept/robot_model/usage_error.hpp"

using namespace swept;

namespace {

const Robot& robot() {
  static const auto kRobot = Robot::load(modelsDir() + "/robots/rook6_cart/rook6_cart.urdf",
                                         modelsDir() + "/robots/rook6_cart/rook6_cart.srdf", {});
  return *kRobot;
}

std::vector<JointTrajectory> read(const std::filesystem::path& file) {
  return readTrajectories(file, robot(), *robot().findGroup("whole_body"));
}

bool areSame(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

/// Whether arithmetic with a trajectory's values may overflow.
bool isHuge(const JointTrajectory& trajectory) {
  const auto huge = [](double value) { return std::abs(value) > 1e100; };
  return std::ranges::any_of(trajectory.points, [&](const TrajectoryPoint& point) {
    return huge(point.time) || std::ranges::any_of(point.positions, huge) ||
           std::ranges::any_of(point.velocities, huge) ||
           std::ranges::any_of(point.accelerations, huge);
  });
}

void requireSame(const JointTrajectory& written, const JointTrajectory& again, double rounding) {
  if (again.variables != written.variables || again.points.size() != written.points.size())
    fuzz::fail("another trajectory is read again");
  for (std::size_t i = 0; i < written.points.size(); ++i) {
    const TrajectoryPoint& a = written.points[i];
    const TrajectoryPoint& b = again.points[i];
    // Beyond 2^22 s the nearest double to a whole nanosecond is farther away than that.
    if (!(std::abs(a.time - b.time) <= rounding * std::max(1.0, a.time * 0x1p-22)))
      fuzz::fail("another time is read again");
    if (!areSame(a.positions, b.positions) || !areSame(a.velocities, b.velocities) ||
        !areSame(a.accelerations, b.accelerations))
      fuzz::fail("other values are read again");
  }
}

/// What is read of what was written. None where a message cannot hold the times.
std::vector<JointTrajectory> again(const std::string& name, const JointTrajectory& trajectory,
                                   TrajectoryMessage message) {
  const auto file = fuzz::files().write(name, "");
  try {
    writeTrajectory(file, trajectory, robot(), message);
  } catch (const UsageError&) {
    if (name != "again.yaml") throw;
    return {};
  }
  return read(file);
}

void requireRoundTrips(const JointTrajectory& trajectory) {
  for (const char* name : {"again.csv", "again.json", "again.yaml"}) {
    const bool isMessage = name == std::string("again.yaml");
    const auto one = again(name, trajectory, TrajectoryMessage::Joint);
    if (one.size() > 1) fuzz::fail("several trajectories are read again");
    if (!one.empty()) requireSame(trajectory, one.front(), isMessage ? 0.51e-9 : 0.0);
  }
  for (const auto message : {TrajectoryMessage::Robot, TrajectoryMessage::Display})
    if (const auto one = again("again.yaml", trajectory, message);
        !one.empty() && one.front().points.size() != trajectory.points.size())
      fuzz::fail("other points are read again");
}

void requireCurve(const JointTrajectory& trajectory) {
  try {
    const PiecewisePolynomial curve = controllerCurve(trajectory);
    if (curve.begin() != trajectory.points.front().time ||
        curve.end() != trajectory.points.back().time)
      fuzz::fail("a curve of other times");
    const Eigen::VectorXd first = curve.position(curve.begin());
    if (!isHuge(trajectory) && !std::ranges::equal(first, trajectory.points.front().positions))
      fuzz::fail("a curve that begins elsewhere");
  } catch (const std::invalid_argument&) {
    if (trajectory.points.size() > 1 && !isHuge(trajectory)) throw;
  }
}

}  // namespace

/// The first byte chooses the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string name = data[0] == 'c'   ? "trajectory.csv"
                           : data[0] == 'j' ? "trajectory.json"
                                            : "trajectory.yaml";
  const auto file = fuzz::files().write(name, fuzz::textOf(data + 1, size - 1));
  std::vector<JointTrajectory> trajectories;
  fuzz::mayRefuse([&] {
    trajectories = read(file);
    if (trajectories.empty()) fuzz::fail("no trajectory");
  });
  try {
    for (const JointTrajectory& trajectory : trajectories) {
      requireRoundTrips(trajectory);
      requireCurve(trajectory);
    }
  } catch (const std::exception& error) {
    fuzz::fail(std::string("what was read is refused: ") + error.what());
  }
  return 0;
}
