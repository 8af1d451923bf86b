// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_curve_json.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "page/packed.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

Json placeJson(const TrajectoryPlace& place) {
  return {{"time", place.time}, {"piece", place.piece}};
}

/// Piece by piece, and of each value its coefficients.
std::string packedCoefficients(const PiecewisePolynomial& curve) {
  std::vector<double> numbers;
  for (std::size_t piece = 0; piece < curve.pieces(); ++piece) {
    const Eigen::MatrixXd byValue = curve.coefficients(piece).transpose();
    numbers.insert(numbers.end(), byValue.data(), byValue.data() + byValue.size());
  }
  return packed<double>(numbers);
}

Json degreesJson(const PiecewisePolynomial& curve) {
  Json degrees = Json::array();
  for (std::size_t piece = 0; piece < curve.pieces(); ++piece)
    degrees.push_back(curve.degree(piece));
  return degrees;
}

const Variable& variableOf(const Checker& checker, int index) {
  return checker.robot().variables()[static_cast<std::size_t>(index)];
}

Json curveLimitsJson(const Checker& checker, const TrajectoryQuery& query) {
  Json lower = Json::array(), upper = Json::array();
  for (const int index : checker.group().variables) {
    const Variable& variable = variableOf(checker, index);
    const bool none = variable.cyclic || isOrientation(checker.robot(), variable);
    lower.push_back(none ? Json(nullptr) : finiteOrNull(variable.lower));
    upper.push_back(none ? Json(nullptr) : finiteOrNull(variable.upper));
  }
  Json json = {{"lower", std::move(lower)}, {"upper", std::move(upper)}};
  const auto rates = [&](std::vector<double> RateLimits::*rate) {
    return query.limits ? toJson(std::span<const double>((*query.limits).*rate)) : Json(nullptr);
  };
  json["velocity"] = rates(&RateLimits::velocity);
  json["acceleration"] = rates(&RateLimits::acceleration);
  json["jerk"] = rates(&RateLimits::jerk);
  return json;
}

/// What CheckerOptions::tracking allows each value; null for components of an orientation, and for
/// all if it allows nothing.
Json tubeJson(const Checker& checker) {
  const TrackingTolerance& tracking = checker.options().tracking;
  Json tube = Json::array();
  bool any = false;
  for (const int index : checker.group().variables) {
    const Variable& variable = variableOf(checker, index);
    const Joint& joint = checker.robot().joints()[static_cast<std::size_t>(variable.joint)];
    const auto own = tracking.joints.find(joint.name);
    const auto& tolerance =
        own == tracking.joints.end() ? static_cast<const JointTolerance&>(tracking) : own->second;
    any = any || tolerance.rotation > 0.0 || tolerance.translation > 0.0;
    if (isOrientation(checker.robot(), variable))
      tube.push_back(nullptr);
    else if (unitOf(checker.robot(), variable) == "m")
      tube.push_back(tolerance.translation);
    else
      tube.push_back(tolerance.rotation);
  }
  return any ? tube : Json(nullptr);
}

Json violationsJson(const TrajectoryCertificate& certificate) {
  Json json = Json::array();
  for (const LimitViolation& violation : certificate.violations) {
    Json entry = placeJson(violation);
    entry["variable"] = violation.variable;
    entry["kind"] = toString(violation.kind);
    entry["value"] = violation.value;
    entry["limit"] = violation.limit;
    json.push_back(std::move(entry));
  }
  return json;
}

Json contactJson(const TrajectoryContact& contact) {
  Json json = placeJson(contact);
  const Eigen::VectorXd& q = contact.configuration;
  json["values"] = toJson(std::span<const double>(q.data(), static_cast<std::size_t>(q.size())));
  json["beside"] = !contact.witness.configuration.empty();
  return json;
}

Json clearanceJson(const TrajectoryClearance& clearance) {
  Json json = placeJson(clearance);
  json["lower"] = finiteOrNull(clearance.lower);
  json["upper"] = finiteOrNull(clearance.upper);
  json["body_a"] = clearance.bodyA;
  json["body_b"] = clearance.bodyB;
  return json;
}

std::string packedStates(const std::vector<std::vector<double>>& states) {
  std::vector<double> numbers;
  for (const std::vector<double>& state : states)
    numbers.insert(numbers.end(), state.begin(), state.end());
  return packed<double>(numbers);
}

}  // namespace

Json curveJson(const Checker& checker, const PageContent::Trajectory& trajectory,
               const CurvePieces& pieces) {
  const TrajectoryCertificate& certificate = trajectory.certificate;
  Json json = {{"knots", packed<double>(trajectory.curve.knots())},
               {"degrees", degreesJson(trajectory.curve)},
               {"coefficients", packedCoefficients(trajectory.curve)},
               {"free_until", certificate.freeUntil},
               {"clock", trajectory.query.clock},
               {"violations", violationsJson(certificate)},
               {"limits", curveLimitsJson(checker, trajectory.query)},
               {"tube", tubeJson(checker)},
               {"polyline", packedStates(trajectory.polyline)}};
  json["contact"] = certificate.contact ? contactJson(*certificate.contact) : Json(nullptr);
  json["undecided"] = certificate.undecided ? placeJson(*certificate.undecided) : Json(nullptr);
  json["clearance"] = {{"world", clearanceJson(pieces.world)},
                       {"self", clearanceJson(pieces.self)}};
  return json;
}

}  // namespace swept
