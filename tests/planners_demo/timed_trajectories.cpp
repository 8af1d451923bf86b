// SPDX-License-Identifier: BSD-3-Clause
#include "timed_trajectories.hpp"

#include <regex>
#include <sstream>

namespace swept::test {

std::vector<GantryPoint> gantryPoints(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  if (line != "time,slide,lift,slide_velocity,lift_velocity") return {};
  std::vector<GantryPoint> points;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<double> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::stod(cell));
    points.push_back({values.at(0), {values.at(1), values.at(2)}, {values.at(3), values.at(4)}});
  }
  return points;
}

std::vector<double> cubicAt(const GantryPoint& from, const GantryPoint& to, double time) {
  const double length = to.time - from.time;
  const double u = (time - from.time) / length;
  std::vector<double> q;
  for (std::size_t i = 0; i < from.position.size(); ++i)
    q.push_back((1 + 2 * u) * (1 - u) * (1 - u) * from.position[i] +
                u * (1 - u) * (1 - u) * length * from.velocity[i] +
                u * u * (3 - 2 * u) * to.position[i] + u * u * (u - 1) * length * to.velocity[i]);
  return q;
}

double durationIn(const std::string& text) {
  static const std::regex kDuration("duration +([0-9.]+) s");
  std::smatch found;
  return std::regex_search(text, found, kDuration) ? std::stod(found[1]) : -1.0;
}

}  // namespace swept::test
