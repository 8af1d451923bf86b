// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_output.hpp"

namespace swept {
namespace {

struct SeriesKind {
  Validator::Kind kind;
  const char* name;
};
// In the order of their colours and markers.
constexpr SeriesKind kSeries[] = {{Validator::Kind::Certified, "certified, by tolerance"},
                                  {Validator::Kind::Discrete, "discrete, by step"},
                                  {Validator::Kind::Fcl, "discrete with FCL, by step"}};

std::string labelOf(const ReportMethod& method) {
  const std::string number = shortNumber(method.setting);
  return method.kind == Validator::Kind::Certified ? number + " m" : number;
}

/// `value` of a row, or none: no point.
template <typename Value>
Plot plotOf(Plot plot, const std::vector<ReportRow>& rows, const Value& value) {
  int style = 0;
  for (const auto& [kind, name] : kSeries) {
    PlotSeries series{.name = name, .style = style++, .points = {}};
    for (const ReportRow& row : rows) {
      const std::optional<double> y = value(row);
      if (row.method.kind != kind || !y || !(row.mean > 0.0)) continue;
      series.points.push_back({.x = row.mean,
                               .y = *y,
                               .label = labelOf(row.method),
                               .title = row.method.name() + ": " + shortNumber(*y) + ", " +
                                        shortNumber(row.mean) + " ns"});
    }
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

/// The curves that may collide. A marker is where its curve's collisions and time are.
Plot executedPlot(Plot plot, const std::vector<ExecutedRow>& rows) {
  constexpr std::pair<const char*, const char*> kCurves[] = {
      {"blends", "blends, by deviation"}, {"tube", "tube, by tolerance"}, {"spline", "spline"}};
  int style = 0;
  for (const auto& [curve, name] : kCurves) {
    PlotSeries series{.name = name, .style = style++, .points = {}};
    for (const ExecutedRow& row : rows)
      if (row.curve == curve)
        series.points.push_back({.x = row.mean,
                                 .y = row.collisionRate(),
                                 .label = row.setting ? shortNumber(*row.setting) : row.curve,
                                 .title = row.name() + ": " + shortNumber(row.collisionRate()) +
                                          ", " + shortNumber(row.mean) + " ns"});
    if (!series.points.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace

std::vector<ReportPicture> reportPictures(const ErrorReport& report) {
  std::vector<ReportPicture> pictures;
  const auto add = [&](const std::string& name, Plot plot) {
    if (!plot.series.empty()) pictures.push_back({.name = name, .plot = std::move(plot)});
  };
  const std::string of = report.robot + ": ";
  const std::vector<ReportRow> motions = report.rowsOf(ReportPart::Motions);
  add("missed", plotOf({.title = of + "collisions that are missed",
                        .yLabel = "of the motions that collide",
                        .unit = Plot::Unit::Share,
                        .series = {}},
                       motions, [](const ReportRow& row) { return row.rates->missedRate(); }));
  add("false-alarms",
      plotOf({.title = of + "free motions that are refused",
              .yLabel = "of the motions that are free",
              .unit = Plot::Unit::Share,
              .series = {}},
             motions, [](const ReportRow& row) { return row.rates->falseAlarmRate(); }));
  for (const ReportPart part : {ReportPart::FirstContact, ReportPart::Clearance,
                                ReportPart::Distance, ReportPart::Penetration}) {
    std::string name = toString(part);
    if (part == ReportPart::FirstContact) name = "first-contact";
    add(name, plotOf({.title = of + "error of the " + toString(part),
                      .yLabel = "mean error",
                      .unit = Plot::Unit::Metres,
                      .series = {}},
                     report.rowsOf(part),
                     [](const ReportRow& row) { return std::optional(row.error->mean); }));
  }
  add("executed-curves", executedPlot({.title = of + "free paths whose curves collide",
                                       .yLabel = "of the paths",
                                       .unit = Plot::Unit::Share,
                                       .series = {}},
                                      report.executed.rows));
  return pictures;
}

}  // namespace swept
