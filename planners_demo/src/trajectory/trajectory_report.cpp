// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/trajectory_report.hpp"

#include <algorithm>
#include <cmath>

#include "output/terminal_text.hpp"
#include "output/violation_json.hpp"

namespace swept {
namespace {

std::string placeText(const TrajectoryPlace& place) {
  return shortNumber(place.time) + " s, between points " + std::to_string(place.piece + 1) +
         " and " + std::to_string(place.piece + 2);
}

/// `velocity of elbow 2.4, allowed 2: at 0.5 s, between points 3 and 4`.
std::string violationText(const LimitViolation& violation) {
  return escapedLine(toString(violation.kind) + std::string(" of ") + violation.variable + " " +
                     shortNumber(violation.value) + ", allowed " + shortNumber(violation.limit)) +
         ": at " + placeText(violation);
}

std::string clearanceLine(const std::string& kind, const TrajectoryClearance& clearance) {
  if (std::isinf(clearance.lower)) return "  " + kind + "no pair to check\n";
  if (std::isinf(clearance.upper)) return "  " + kind + "not known\n";
  return "  " + kind + lengthText(clearance.lower) + " to " + lengthText(clearance.upper) +
         escapedLine(", " + clearance.bodyA.str() + " - " + clearance.bodyB.str()) + ", at " +
         placeText(clearance) + "\n";
}

Json placeJson(const TrajectoryPlace& place) {
  return {{"time", place.time}, {"piece", place.piece}};
}

Json clearanceJson(const TrajectoryClearance& clearance) {
  Json json = {{"lower", finiteOrNull(clearance.lower)}, {"upper", finiteOrNull(clearance.upper)}};
  json.update(placeJson(clearance));
  json["body_a"] = clearance.bodyA.str();
  json["body_b"] = clearance.bodyB.str();
  return json;
}

/// `4 corners: 3 blended, 1 stop`.
std::string cornersText(const TimingReport& timing) {
  const std::size_t corners = timing.blended + timing.stops;
  if (corners == 0) return "no corner";
  return countedText(corners, "corner") + ": " + std::to_string(timing.blended) + " blended, " +
         countedText(timing.stops, "stop");
}

}  // namespace

ExitCode codeOf(const TrajectoryCertificate& certificate) {
  const ExitCode code = exitCodeOf(certificate.verdict);
  return certificate.violations.empty() ? code : worse(code, ExitCode::Collision);
}

std::string reasonNotToWrite(const TrajectoryCertificate& certificate) {
  if (certificate.verdict != Verdict::Free) return "it is not free";
  const bool leaves = std::ranges::any_of(
      certificate.violations,
      [](const LimitViolation& violation) { return violation.kind == LimitKind::Position; });
  return leaves ? "it leaves limits of positions" : "";
}

std::string trajectoryText(const TrajectoryReport& report) {
  const TrajectoryCertificate& found = report.certificate;
  std::string text = (report.label.empty() ? "trajectory" : escapedLine(report.label)) + ": " +
                     painted(found.verdict) + "\n";
  text += "  duration    " + shortNumber(report.end - report.begin) + " s, " +
          countedText(report.points, "point") + "\n";
  if (report.timing)
    text += "  timing      " + secondsText(report.timing->seconds) + ", " +
            cornersText(*report.timing) + "\n";
  if (found.verdict != Verdict::Free)
    text += "  free until  " + shortNumber(found.freeUntil) + " s\n";
  if (found.contact) {
    text += "  contact     " + placeText(*found.contact) + ": " +
            witnessText(found.contact->witness) + "\n";
    if (!found.contact->witness.configuration.empty())
      text += "              in the tube, beside the curve\n";
  }
  if (found.violation)
    text += "  constraint  " + placeText(*found.violation) + ": " +
            escapedLine(describe(found.violation->violation, *report.constraints)) + "\n";
  if (found.undecided) text += "  undecided   " + placeText(*found.undecided) + "\n";
  for (const LimitViolation& violation : found.violations)
    text += "  limit       " + violationText(violation) + "\n";
  if (found.world) text += clearanceLine("world       ", *found.world);
  if (found.self) text += clearanceLine("self        ", *found.self);
  const Effort& effort = found.effort;
  return text + "  effort      intervals in lanes " + std::to_string(effort.lanes) + ", exactly " +
         std::to_string(effort.intervals) + "; distances " + std::to_string(effort.distances) +
         ", settled by bounding volumes " + std::to_string(effort.culled) + "\n";
}

Json trajectoryJson(const TrajectoryReport& report) {
  const TrajectoryCertificate& found = report.certificate;
  Json json = {{"label", report.label},
               {"points", report.points},
               {"begin", report.begin},
               {"end", report.end},
               {"verdict", toString(found.verdict)},
               {"free_until", found.freeUntil}};
  if (report.timing) {
    json["corners"] = report.timing->blended + report.timing->stops;
    json["blended"] = report.timing->blended;
    json["stops"] = report.timing->stops;
    json["timing_time"] = report.timing->seconds;
  }
  json["contact"] = nullptr;
  if (found.contact) {
    json["contact"] = placeJson(*found.contact);
    json["contact"]["in_tube"] = !found.contact->witness.configuration.empty();
    json["contact"]["configuration"] = toJson(
        std::span<const double>(found.contact->configuration.data(),
                                static_cast<std::size_t>(found.contact->configuration.size())));
    json["contact"]["witness"] = toJson(found.contact->witness);
  }
  if (found.violation) {
    json["violation"] = violationJson(found.violation->violation, *report.constraints);
    json["violation"].update(placeJson(*found.violation));
  }
  json["undecided"] = found.undecided ? placeJson(*found.undecided) : Json(nullptr);
  json["violations"] = Json::array();
  for (const LimitViolation& violation : found.violations) {
    Json own = {{"variable", violation.variable},
                {"kind", toString(violation.kind)},
                {"value", violation.value},
                {"limit", violation.limit}};
    own.update(placeJson(violation));
    json["violations"].push_back(std::move(own));
  }
  json["clearance_world"] = found.world ? clearanceJson(*found.world) : Json(nullptr);
  json["clearance_self"] = found.self ? clearanceJson(*found.self) : Json(nullptr);
  json["effort"] = {{"intervals", found.effort.intervals},
                    {"lanes", found.effort.lanes},
                    {"distances", found.effort.distances},
                    {"culled", found.effort.culled}};
  return json;
}

}  // namespace swept
