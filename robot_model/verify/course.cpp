// SPDX-License-Identifier: BSD-3-Clause
#include "course.hpp"

#include "rounding.hpp"

namespace swept::verify {
namespace {

/// Times that an interval is halved at most. Where a value only touches a limit, the two are then
/// as near as doubles are.
constexpr int kHalvings = 48;

bool staysWithin(const Curve<double>& curve, double lower, double upper, double middle, double half,
                 int halvings) {
  const Around<double> here = around(curve, middle, half);
  if (here.value - here.range >= lower && here.value + here.range <= upper) return true;
  if (!(here.value >= lower && here.value <= upper) || halvings == 0) return false;
  const double quarter = 0.5 * half;
  return staysWithin(curve, lower, upper, middle - quarter, quarter, halvings - 1) &&
         staysWithin(curve, lower, upper, middle + quarter, quarter, halvings - 1);
}

}  // namespace

Course straightCourse(double from, double difference, double to) {
  return {.curve = {.degree = 1, .start = from, .steps = {difference}},
          .begin = std::abs(from),
          .end = std::abs(to)};
}

bool isCurved(const Point& from, const Point& to) {
  return !from.velocities.empty() && !to.velocities.empty();
}

Course courseOf(const Point& from, const Point& to, std::size_t variable) {
  const double begin = from.positions[variable], end = to.positions[variable];
  if (!isCurved(from, to)) return straightCourse(begin, end - begin, end);
  const bool quintic = !from.accelerations.empty() && !to.accelerations.empty();
  const std::size_t degree = quintic ? 5 : 3;
  const auto order = static_cast<double>(degree);
  const double time = to.time - from.time;
  // The first coefficients have the derivatives at the begin, the last ones those at the end.
  const double leave = time * from.velocities[variable] / order;
  const double arrive = time * to.velocities[variable] / order;
  double bendFirst = 0.0, bendLast = 0.0;
  if (quintic) {
    // Not by the square of the time, which may underflow.
    bendFirst = time * (time * from.accelerations[variable]) / 20.0;
    bendLast = time * (time * to.accelerations[variable]) / 20.0;
  }
  Course course{.curve = {.degree = degree, .start = begin, .steps = {}}};
  if (quintic)
    course.curve.steps = {leave, leave + bendFirst,
                          (end - begin) - 2.0 * leave - 2.0 * arrive - bendFirst + bendLast,
                          arrive - bendLast, arrive};
  else
    course.curve.steps = {leave, (end - begin) - leave - arrive, arrive};
  // A product that underflows is off by as much, however large the numbers beside it are.
  course.begin = kUnderflow + std::max(std::abs(begin), std::abs(end)) + std::abs(end - begin) +
                 4.0 * (std::abs(leave) + std::abs(arrive)) +
                 2.0 * (std::abs(bendFirst) + std::abs(bendLast));
  course.end = course.begin;
  return course;
}

bool staysWithin(const Course& course, double lower, double upper) {
  return staysWithin(course.curve, lower, upper, 0.5, 0.5, kHalvings);
}

}  // namespace swept::verify
