// SPDX-License-Identifier: BSD-3-Clause
#include "cover/cover_output.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>

#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "output/text_table.hpp"

namespace swept {
namespace {

std::string millimetres(double metres) {
  return std::isfinite(metres) ? shortNumber(std::round(metres * 1e5) / 1e2) : "-";
}

std::string percentOf(double share) {
  return std::isfinite(share) ? shortNumber(std::round(share * 1e3) / 10.0) : "-";
}

std::string ratioText(double ratio) {
  return std::isfinite(ratio) ? shortNumber(std::round(ratio * 100.0) / 100.0) : "-";
}

struct CoverTotals {
  std::size_t spheres = 0;
  double largest = 0.0;                                       ///< m
  double mean = 0.0;                                          ///< m, of the links
  double outside = -std::numeric_limits<double>::infinity();  ///< m
};

CoverTotals totalsOf(const std::vector<LinkSphereReport>& reports) {
  CoverTotals totals;
  for (const LinkSphereReport& report : reports) {
    totals.spheres += report.spheres;
    totals.largest = std::max(totals.largest, report.excess.largest);
    totals.mean += report.excess.mean / static_cast<double>(reports.size());
    totals.outside = std::max(totals.outside, report.outside.upper);
  }
  return totals;
}

std::string excessText(const CoverTotals& totals, const std::string& what) {
  return countedText(totals.spheres, what) + ", largest excess " + millimetres(totals.largest) +
         " mm, mean excess " + millimetres(totals.mean) + " mm\n";
}

/// What the texts call the shapes, and what they contain.
struct Terms {
  std::string shape;  ///< `sphere` or `shape`
  std::string body;   ///< `link` or `body`
  std::string bodies;
};

std::string coverText(const std::vector<LinkSphereReport>& reports, const Terms& terms) {
  const std::string& what = terms.shape;
  TextTable table({{terms.body},
                   {what + "s", true},
                   {"largest excess (mm)", true},
                   {"mean (mm)", true},
                   {"volume ratio", true}});
  for (const LinkSphereReport& report : reports)
    table.add({report.link, std::to_string(report.spheres), millimetres(report.excess.largest),
               millimetres(report.excess.mean), ratioText(report.excess.volumeRatio)});
  return table.text() + excessText(totalsOf(reports), what);
}

std::string checkText(const std::vector<LinkSphereReport>& reports, const Terms& terms) {
  const std::string& what = terms.shape;
  TextTable table({{terms.body},
                   {what + "s", true},
                   {"outside (mm)", true},
                   {"surface outside (%)", true},
                   {"farthest point (m)"},
                   {"inflated: largest excess (mm)", true},
                   {"mean (mm)", true}});
  for (const LinkSphereReport& report : reports) {
    const bool none = report.spheres == 0;
    const bool isOut = report.outside.upper > 0.0;
    table.add({report.link, std::to_string(report.spheres),
               none ? "all of it"
               : isOut
                   ? millimetres(report.outside.lower) + " to " + millimetres(report.outside.upper)
                   : "0",
               percentOf(report.outside.surfaceShare),
               isOut && !none ? pointText(report.outside.point) : "",
               none ? "-" : millimetres(report.excess.largest),
               none ? "-" : millimetres(report.excess.mean)});
  }
  const CoverTotals totals = totalsOf(reports);
  std::string text = table.text();
  if (totals.outside <= 0.0) {
    text += "the " + what + "s contain all " + terms.bodies + ": proven\n";
  } else if (std::isfinite(totals.outside)) {
    text += "the least inflation that encloses all " + terms.bodies + ": " +
            millimetres(totals.outside) + " mm\n";
  } else {
    text += "no inflation encloses " + terms.bodies + " without " + what + "s\n";
  }
  return text + "each " + terms.body + " inflated as it needs: " + excessText(totals, what);
}

Json reportJson(const LinkSphereReport& report, const std::string& body) {
  return {{body, report.link},
          {"spheres", report.spheres},
          {"outside_lower", finiteOrNull(report.outside.lower)},
          {"outside_upper", finiteOrNull(report.outside.upper)},
          {"farthest_point", toJson(report.outside.point)},
          {"surface_share_outside", report.outside.surfaceShare},
          {"largest_excess", finiteOrNull(report.excess.largest)},
          {"largest_excess_seen", finiteOrNull(report.excess.largestSeen)},
          {"mean_excess", finiteOrNull(report.excess.mean)},
          {"volume_ratio", finiteOrNull(report.excess.volumeRatio)}};
}

}  // namespace

void printCover(const Arguments& args, const Covered& covered, const ShapeModel& model,
                const std::vector<LinkSphereReport>& reports, double seconds) {
  const bool isScene = covered.world != nullptr;
  const Terms terms{.shape = sphereModelOf(model) ? "sphere" : "shape",
                    .body = isScene ? "body" : "link",
                    .bodies = isScene ? "bodies" : "links"};
  if (!args.json) {
    std::string text =
        args.cover.check.empty() ? coverText(reports, terms) : checkText(reports, terms);
    text += secondsText(seconds) + "\n";
    if (!args.output.empty()) text += "written to " + escapedLine(args.output) + "\n";
    printText(text);
    return;
  }
  Json json = {{isScene ? "scene" : "robot", covered.name},
               {"checked", args.cover.check.empty() ? Json(nullptr) : Json(args.cover.check)},
               {"output", args.output.empty() ? Json(nullptr) : Json(args.output)},
               {"seconds", seconds},
               {terms.bodies, Json::array()}};
  for (const LinkSphereReport& report : reports)
    json[terms.bodies].push_back(reportJson(report, terms.body));
  std::cout << dumped(json) << '\n';
}

}  // namespace swept
