// SPDX-License-Identifier: BSD-3-Clause
#include "check/segment_report.hpp"

#include <cmath>

#include "output/clearance_text.hpp"
#include "output/terminal_text.hpp"
#include "output/violation_json.hpp"

namespace swept {
namespace {

/// The lesser one first.
std::string clearanceLines(const MotionClearance& clearance) {
  if (std::isinf(clearance.lower)) return "  clearance   no pair to check\n";
  const auto line = [](const std::string& kind, const ClearanceInterval& of) {
    return "  " + kind + std::string(12 - kind.size(), ' ') + boundsText(of);
  };
  return line("clearance", clearance) +
         (clearance.selfPair ? " (self)\n" + line("world", clearance.world)
                             : " (world)\n" + line("self", clearance.self)) +
         "\n";
}

/// `t = 0.25`, and with times `t = 0.25 (1.5 s)`.
std::string placeText(const SegmentReport& segment, double t) {
  const std::string place = "t = " + shortNumber(t);
  if (!segment.times) return place;
  const auto [begin, end] = *segment.times;
  return place + " (" + shortNumber(begin + t * (end - begin)) + " s)";
}

}  // namespace

std::optional<std::pair<double, double>> timesBetween(const LabelledState& from,
                                                      const LabelledState& to) {
  if (!from.time || !to.time) return std::nullopt;
  return std::pair(*from.time, *to.time);
}

std::string segmentText(const SegmentReport& segment) {
  const MotionCertificate& certificate = segment.certificate;
  std::string text =
      escapedLine(segment.from + " to " + segment.to) + ": " + painted(certificate.verdict) +
      (certificate.witness && keepsApart(*certificate.witness) ? " (closer than the margin)\n"
                                                               : "\n");
  if (certificate.verdict != Verdict::Free)
    text += "  free until  " + placeText(segment, certificate.freeUntil) + "\n";
  if (certificate.witness)
    text += "  contact     " + placeText(segment, certificate.witness->t) + ", " +
            witnessText(*certificate.witness) + "\n";
  if (certificate.violation)
    text += "  constraint  " + placeText(segment, certificate.violation->t) + ", " +
            escapedLine(describe(*certificate.violation, *segment.constraints)) + "\n";
  if (certificate.verdict == Verdict::Undecided)
    text += "  undecided   " + placeText(segment, certificate.undecidedAt) + "\n";
  if (segment.clearance) text += clearanceLines(*segment.clearance);
  const Effort& effort = certificate.effort;
  return text + "  effort      intervals in lanes " + std::to_string(effort.lanes) + ", exactly " +
         std::to_string(effort.intervals) + "; distances " + std::to_string(effort.distances) +
         ", settled by bounding volumes " + std::to_string(effort.culled) + "\n";
}

Json segmentJson(const SegmentReport& segment) {
  const MotionCertificate& certificate = segment.certificate;
  Json json = {{"from", segment.from},
               {"to", segment.to},
               {"verdict", toString(certificate.verdict)},
               {"free_until", certificate.freeUntil}};
  if (segment.times) json["times"] = {segment.times->first, segment.times->second};
  json["witness"] = certificate.witness ? toJson(*certificate.witness) : Json(nullptr);
  json["undecided_at"] =
      certificate.verdict == Verdict::Undecided ? Json(certificate.undecidedAt) : Json(nullptr);
  if (certificate.violation)
    json["violation"] = violationJson(*certificate.violation, *segment.constraints);
  const std::optional<MotionClearance>& clearance = segment.clearance;
  json["clearance"] = clearance ? boundsJson(*clearance) : Json(nullptr);
  json["clearance_world"] = clearance ? boundsJson(clearance->world) : Json(nullptr);
  json["clearance_self"] = clearance ? boundsJson(clearance->self) : Json(nullptr);
  json["effort"] = {{"intervals", certificate.effort.intervals},
                    {"lanes", certificate.effort.lanes},
                    {"distances", certificate.effort.distances},
                    {"culled", certificate.effort.culled}};
  return json;
}

}  // namespace swept
