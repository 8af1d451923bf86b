// SPDX-License-Identifier: BSD-3-Clause
#include "planning/end_report.hpp"

#include <algorithm>
#include <limits>

#include "certificate/model_json.hpp"
#include "swept/core/signed_distance.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;

/// Where what moves with a link is in a state.
Isometry3d placeOf(const Checker& checker, const CertifiedBody& body,
                   const std::vector<double>& q) {
  if (body.link < 0) return Isometry3d::Identity();
  const Robot& robot = checker.robot();
  return LinkMotion(robot, checker.group().name, robot.links()[body.link].name, q, q,
                    checker.options().reference)
      .at(0.0);
}

/// m. The deepest of all pairs of their parts.
double depthOf(const Checker& checker, const CertifiedBody& a, const CertifiedBody& b,
               const std::vector<double>& q) {
  const Isometry3d a_from_b = placeOf(checker, a, q).inverse() * placeOf(checker, b, q);
  double deepest = -std::numeric_limits<double>::infinity();
  for (const CertifiedBody::Part& partA : a.parts)
    for (const CertifiedBody::Part& partB : b.parts) {
      const SignedDistanceResult found =
          signedDistance(partA.shape, partB.shape,
                         partA.body_from_shape.inverse() * a_from_b * partB.body_from_shape,
                         clearanceAccuracy(checker));
      deepest = std::max(deepest, -found.lower);
    }
  return deepest;
}

/// That of the contact's second body: a body of the world may have the name of a link.
const CertifiedBody* secondOf(const std::vector<CertifiedBody>& bodies, const Witness& contact) {
  const auto found = std::ranges::find_if(bodies, [&contact](const CertifiedBody& body) {
    return body.name == contact.bodyB && (body.link >= 0) == contact.selfPair;
  });
  return found == bodies.end() ? nullptr : &*found;
}

std::string contactText(const EndContact& contact) {
  return contact.bodyA + " - " + contact.bodyB + " (" +
         (contact.depth > 0.0 ? lengthText(contact.depth) + " m deep"
                              : lengthText(-contact.depth) + " m apart, margin " +
                                    lengthText(contact.margin) + " m") +
         (contact.inTube ? ", in the tube beside the state" : "") + ", at " +
         pointText(contact.point) + ")";
}

}  // namespace

EndReport reportEnd(const Checker& checker, const LabelledState& state, Workspace& workspace) {
  const StateReport found = checker.reportState(state.q, workspace);
  EndReport report{.label = state.label, .q = state.q, .verdict = found.verdict};
  for (const ConstraintViolation& violation : found.violations)
    report.violations.push_back(describe(violation, checker.options().constraints));
  if (found.contacts.empty()) return report;
  const std::vector<CertifiedBody> bodies = certifiedBodies(checker);
  for (const Witness& contact : found.contacts) {
    const auto a = std::ranges::find(bodies, contact.bodyA, &CertifiedBody::name);
    const CertifiedBody* b = secondOf(bodies, contact);
    const std::vector<double>& off = contact.configuration;
    const bool inTube = !off.empty();
    report.contacts.push_back({.bodyA = contact.bodyA,
                               .bodyB = contact.bodyB,
                               .depth = a == bodies.end() || b == nullptr
                                            ? -contact.distance
                                            : depthOf(checker, *a, *b, inTube ? off : state.q),
                               .margin = contact.margin,
                               .inTube = inTube,
                               .point = 0.5 * (contact.pointA + contact.pointB)});
  }
  return report;
}

std::string_view whatIs(const EndReport& report) {
  if (report.verdict == Verdict::Free) return "free";
  if (report.verdict == Verdict::Undecided) return "undecided";
  if (report.verdict == Verdict::Violation) return "off a constraint";
  const bool apart =
      std::ranges::all_of(report.contacts, [](const EndContact& c) { return c.depth < 0.0; });
  return apart ? "closer than the margin" : "in collision";
}

std::string endText(const EndReport& report) {
  if (report.verdict == Verdict::Free) return {};
  const std::string text = report.label + " is " + std::string(whatIs(report));
  std::vector<std::string> contacts = report.violations;
  for (const EndContact& contact : report.contacts) contacts.push_back(contactText(contact));
  return contacts.empty() ? text : text + ": " + joined(contacts);
}

Json endJson(const EndReport& report) {
  Json json = {{"label", report.label}, {"verdict", toString(report.verdict)}};
  json["contacts"] = Json::array();
  for (const EndContact& contact : report.contacts)
    json["contacts"].push_back({{"a", contact.bodyA},
                                {"b", contact.bodyB},
                                {"depth", contact.depth},
                                {"margin", contact.margin},
                                {"in_tube", contact.inTube},
                                {"point", toJson(contact.point)}});
  if (!report.violations.empty()) json["violations"] = report.violations;
  return json;
}

}  // namespace swept
