// SPDX-License-Identifier: BSD-3-Clause
// Pages of trajectories, for trajectory_browser.py: trajectory_pages NAME --html FILE.html
// Beside it, FILE.json has what the library says of the first curve at 1001 times.
#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "swept/pages/page.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/named_values.hpp"

namespace {

using nlohmann::json;
using States = std::vector<std::vector<double>>;

std::shared_ptr<const swept::Checker> rook7(const std::string& scene, double tube) {
  const std::string name = "models/robots/rook7/rook7";
  swept::CheckerOptions options;
  options.tracking.rotation = tube;
  return std::make_shared<const swept::Checker>(
      swept::Robot::load(name + ".urdf", name + ".srdf"), "arm",
      std::make_shared<const swept::World>(swept::World::load("models/scenes/" + scene + ".yaml")),
      options);
}

/// The cubic B-spline of points on a polyline, `each` on each of its segments: at rest at both
/// ends, and the nearer to the polyline the more points there are.
swept::PiecewisePolynomial spline(const States& states, int each, double duration) {
  std::vector<Eigen::VectorXd> points;
  const auto at = [&](std::size_t i) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
        states[i].data(), static_cast<Eigen::Index>(states[i].size())));
  };
  for (int i = 0; i < 2; ++i) points.push_back(at(0));
  for (std::size_t i = 0; i + 1 < states.size(); ++i)
    for (int k = 0; k < each; ++k)
      points.push_back(at(i) + (at(i + 1) - at(i)) * (static_cast<double>(k) / each));
  for (int i = 0; i < 3; ++i) points.push_back(at(states.size() - 1));
  Eigen::MatrixXd control(points.front().size(), static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    control.col(static_cast<Eigen::Index>(i)) = points[i];
  const auto pieces = static_cast<int>(points.size()) - 3;
  std::vector<double> knots(4, 0.0);
  for (int i = 1; i < pieces; ++i) knots.push_back(duration * i / pieces);
  knots.insert(knots.end(), 4, duration);
  return swept::PiecewisePolynomial::bSpline(3, knots, control);
}

/// From rest to rest.
swept::PiecewisePolynomial quintic(const States& states, double begin, double duration) {
  const std::vector<double> none(states.front().size(), 0.0);
  swept::JointTrajectory trajectory{std::vector<std::string>(none.size(), "v"), {}};
  double time = begin;
  for (const std::vector<double>& state : states) {
    trajectory.points.push_back({time, state, none, none});
    time += duration / static_cast<double>(states.size() - 1);
  }
  return swept::controllerCurve(trajectory);
}

/// Velocities as rook7.urdf has them.
swept::TrajectoryQuery limits(double acceleration) {
  swept::TrajectoryQuery query;
  query.limits = swept::RateLimits{.velocity = {2.0, 2.0, 2.0, 2.0, 2.6, 2.6, 2.6},
                                   .acceleration = std::vector<double>(7, acceleration),
                                   .jerk = std::vector<double>(7, INFINITY)};
  return query;
}

std::vector<double> listed(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

/// What a page's curve is, in the library's words. The tip is where the library puts it.
json oracle(const swept::Checker& checker, const swept::PiecewisePolynomial& curve,
            const States& polyline) {
  const swept::Group& group = checker.group();
  const std::string tip = checker.robot().links()[std::size_t(group.tipLink)].name;
  const auto tipAt = [&](swept::ConfigurationView q) {
    return listed(swept::linkPose(checker.robot(), group.name, tip, q).translation());
  };
  json all;
  for (int i = 0; i <= 1000; ++i) {
    const double time = curve.begin() + curve.duration() * i / 1000;
    all["times"].push_back(time);
    all["position"].push_back(listed(curve.position(time)));
    all["velocity"].push_back(listed(curve.velocity(time)));
    all["acceleration"].push_back(listed(curve.acceleration(time)));
    const bool within = checker.withinLimits(curve.position(time));
    all["tip"].push_back(within ? json(tipAt(curve.position(time))) : json(nullptr));
  }
  all["way_points"] = json::array();
  for (const std::vector<double>& state : polyline) all["way_points"].push_back(tipAt(state));
  return all;
}

struct Made {
  std::shared_ptr<const swept::Checker> checker;
  swept::Page page;
  swept::PiecewisePolynomial curve;
  States polyline = {};
};

const States kShelf{{0.23, 0.53, 0.12, 1.44, 0.35, -0.73, 0.11},
                    {-0.000317028, 0.219053, 0.540241, 1.63189, -0.308784, -0.122728, -0.131791},
                    {-0.102006, -0.0819714, 0.934058, 1.80187, -0.658137, 0.426483, -0.289877},
                    {-0.16284, 0.364799, 1.08855, 2.10802, 1.41703, -0.243714, -0.235818},
                    {-0.281195, 0.555585, 0.860087, 2.14482, 1.15058, -0.581043, -0.336053},
                    {-0.32, 0.78, 0.2, 1.9, 0.01, -0.77, -0.14}};

/// Free with its tube, within all limits, with the polyline that it was made from.
Made shelf() {
  const auto checker = rook7("shelf", 0.0002);
  const swept::PiecewisePolynomial curve = spline(kShelf, 6, 4.5);
  swept::Page page(checker);
  page.addTrajectory("blended", curve, limits(25.0), kShelf);
  return {checker, std::move(page), curve, kShelf};
}

const States kSlot{{0, -0.5, 0, 1.0, 0, 0.4, 0}, {0, -0.3, 0, 1.9, 0, 1.54, 0}};

/// Hits the lintel beside its curve, and is too fast.
Made slot() {
  const auto checker = rook7("narrow_slot", 0.02);
  const swept::PiecewisePolynomial curve = quintic(kSlot, 0.5, 0.8);
  swept::Page page(checker);
  page.addTrajectory("straight through", curve, limits(8.0), kSlot);
  return {checker, std::move(page), curve, kSlot};
}

/// Two in turn, the first of which cuts corners and has a wide tube; without limits of rates.
Made two() {
  const auto checker = rook7("narrow_slot", 0.03);
  const States around{
      kSlot[0], {-0.9, -0.6, 0.5, 1.6, 0.4, 0.6, 0.3}, {-1.5, 0.1, 0, 1.2, 0, 0.4, 0.9}};
  const swept::PiecewisePolynomial curve = spline(around, 1, 2.0);
  swept::Page page(checker);
  page.addTrajectory("around", curve, {}, around);
  page.addTrajectory("there", quintic({kSlot[0], around[1]}, 0.0, 1.0));
  return {checker, std::move(page), curve, around};
}

/// Every kind of joint, at odd angles, and two that follow another one.
std::string oddRobot() {
  const std::pair<const char*, const char*> kJoints[] = {
      {"slide' type='prismatic", "<axis xyz='0.6 0 0.8'/><limit lower='-1' upper='1'/>"},
      {"turn' type='continuous", "<axis xyz='0 1 0'/>"},
      {"bend' type='revolute", "<axis xyz='1 2 2'/><limit lower='-2' upper='2'/>"},
      {"follow' type='revolute",
       "<axis xyz='0 0 1'/><limit lower='-9' upper='9'/><mimic joint='bend' multiplier='-1.5' "
       "offset='0.2'/>"},
      {"creep' type='prismatic",
       "<axis xyz='0 1 0'/><limit lower='-9' upper='9'/><mimic joint='slide' multiplier='0.5' "
       "offset='0.1'/>"},
      {"drive' type='planar", "<axis xyz='1 -1 0.5'/>"},
      {"float' type='floating", ""}};
  std::string links = "<link name='l0'/>", joints;
  int i = 0;
  for (const auto& [name, more] : kJoints) {
    const std::string parent = "l" + std::to_string(i), child = "l" + std::to_string(++i);
    links += "<link name='" + child +
             "'><collision><geometry><sphere radius='0.02'/></geometry></collision></link>";
    joints += std::string("<joint name='") + name + "'><parent link='" + parent +
              "'/><child link='" + child + "'/><origin xyz='0.3 0.1 0.2' rpy='" +
              std::to_string(0.3 * i) + " -0.4 0.5'/>" + more + "</joint>";
  }
  std::string robot = "<robot name='odd'>" + links + joints + "</robot>";
  for (std::size_t at = 0; (at = robot.find("'/>", robot.find(" upper=", at))) != std::string::npos;
       at += 3)
    robot.insert(at + 1, " effort='1' velocity='1'");
  return robot;
}

/// Three pieces of degrees 1, 3 and 1: orientations change along the first and the last one; in
/// between it turns by more than half a turn, and slides beyond a limit.
Made odd() {
  const auto robot = swept::Robot::parse(oddRobot(), "odd.urdf");
  const auto checker =
      std::make_shared<const swept::Checker>(robot, "all", std::make_shared<const swept::World>());
  Eigen::MatrixXd knots(13, 4);
  knots.transpose() << 0.4, 2.9, -1.2, 0.5, -0.7, 2.5, 0.3, -0.2, 0.6, 0.1, 0.7, 0.5, 0.5,  //
      -0.3, 0.5, 1.7, -0.6, 0.2, -1.9, 0.1, 0.5, -0.4, 0.8, 0, 0, 0.6,                      //
      1.3, 5.0, 0.4, 0.3, 0.9, 1.2, -0.5, 0.4, 0.2, 0.8, 0, 0, 0.6,                         //
      0.2, 4.0, -0.8, -0.4, 0.1, 4.0, 0.6, -0.3, 0.7, 0, 0.6, 0.8, 0;
  std::vector<Eigen::MatrixXd> pieces;
  pieces.push_back(knots.leftCols(2));
  Eigen::MatrixXd cubic(13, 4);
  for (int k = 0; k < 4; ++k) cubic.col(k) = knots.col(k < 2 ? 1 : 2);
  pieces.push_back(cubic);
  pieces.push_back(knots.rightCols(2));
  const swept::PiecewisePolynomial curve({0.25, 1.0, 2.5, 3.0}, pieces);
  swept::Page page(checker);
  page.addTrajectory("odd", curve);
  return {checker, std::move(page), curve};
}

}  // namespace

int main(int argc, char** argv) try {
  const std::map<std::string, std::function<Made()>> pages{
      {"shelf", shelf}, {"slot", slot}, {"two", two}, {"odd", odd}};
  if (argc != 4 || !pages.contains(argv[1])) return 2;
  const Made made = pages.at(argv[1])();
  const std::filesystem::path file = argv[3];
  made.page.write(file);
  std::ofstream(std::filesystem::path(file).replace_extension(".json"))
      << oracle(*made.checker, made.curve, made.polyline);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
