// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iterator>

#include "output/text_output.hpp"
#include "report/report.hpp"

namespace swept {
namespace {

std::optional<double> share(std::size_t part, std::size_t whole) {
  if (whole == 0) return {};
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::string ReportMethod::family() const {
  switch (kind) {
    case Validator::Kind::Certified:
      return "certified";
    case Validator::Kind::Discrete:
      return "discrete";
    case Validator::Kind::Fcl:
      break;
  }
  return "fcl";
}

std::string ReportMethod::name() const {
  return family() + ":" + exactNumber(setting);
}

std::optional<double> RateErrors::missedRate() const {
  return share(missed, collisions);
}

std::optional<double> RateErrors::falseAlarmRate() const {
  return share(falseAlarms, free);
}

double ExecutedRow::collisionRate() const {
  return share(collisions, paths()).value_or(0.0);
}

std::optional<double> ExecutedRow::missedRate() const {
  return missed ? share(*missed, collisions) : std::nullopt;
}

std::string ExecutedRow::name() const {
  return setting ? curve + ":" + exactNumber(*setting) : curve;
}

std::string toString(ReportPart part) {
  switch (part) {
    case ReportPart::Motions:
      return "motions";
    case ReportPart::FirstContact:
      return "first contact";
    case ReportPart::Clearance:
      return "clearance";
    case ReportPart::Distance:
      return "distance";
    case ReportPart::Penetration:
      break;
  }
  return "penetration";
}

std::vector<ReportRow> ErrorReport::rowsOf(ReportPart part) const {
  std::vector<ReportRow> found;
  std::ranges::copy_if(rows, std::back_inserter(found),
                       [&](const ReportRow& row) { return row.part == part; });
  return found;
}

}  // namespace swept
