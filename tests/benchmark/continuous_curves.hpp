// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "continuous_plot.hpp"
#include "continuous_workloads.hpp"

/// Error of the first contact against time, as the tolerance or the number of samples changes.
namespace swept::benchmark {

/// Where the curves go besides the table; empty: nowhere.
struct CurveFiles {
  std::string csv, svg;
};

/// How far, in m that the fastest point moves, the answer leaves the first contact open: for a
/// bracket its farther end, for samples the one that hit.
inline double errorOf(const Sweep& sweep, const Answer& answer, bool bracket) {
  const double late = answer.toc - sweep.truth.toc;
  const double open = bracket ? sweep.truth.toc - answer.freeUntil : -late;
  return std::max({0.0, late, open}) * sweep.speed;
}

class CurveRun {
 public:
  explicit CurveRun(const CurveWorkload& work) : work_(work) {}

  void swept(double tolerance) {
    const Method method{"swept", [&, tolerance](const Sweep& sweep) {
                          return ask(work_.still, work_.moving, sweep, tolerance, workspace_,
                                     *sweep.motion);
                        }};
    CurvePoint point;
    point.tolerance = tolerance;
    const std::vector<Answer> answers = measure({method}, true, point);
    for (std::size_t i = 0; i < answers.size(); ++i)
      score_.add(work_.sweeps[i], answers[i], tolerance, kTruthSlack);
  }
#ifdef SWEPT_HAS_FCL
  void naive(int samples) {
    std::vector<Method> methods;
    for (const FclBodies& bodies : work_.peers)
      methods.push_back({"FCL", [&bodies, samples](const Sweep& sweep) {
                           return bodies.samples(sweep, static_cast<std::size_t>(samples));
                         }});
    if (methods.empty()) return;
    CurvePoint point;
    point.samples = samples;
    measure(methods, false, point);
  }
#endif
  const std::vector<CurvePoint>& points() const {
    return points_;
  }
  const Score& score() const {
    return score_;
  }

 private:
  /// m. Truths are bisected to the last bit of t, but poses are rounded.
  static constexpr double kTruthSlack = 1e-11;

  std::vector<Answer> measure(const std::vector<Method>& methods, bool bracket, CurvePoint point) {
    const std::vector<Result> results = compete(methods, work_.sweeps, 5);
    const Result& result = results.front();
    point.workload = work_.name;
    point.contestant = result.name;
    point.meanMicroseconds = 1e6 * result.seconds / static_cast<double>(work_.sweeps.size());
    int found = 0;
    for (std::size_t i = 0; i < work_.sweeps.size(); ++i) {
      if (!result.answers[i].hit) {
        ++point.missed;
        continue;
      }
      ++found;
      const double error = errorOf(work_.sweeps[i], result.answers[i], bracket);
      point.meanError += error;
      point.maxError = std::max(point.maxError, error);
    }
    point.meanError /= std::max(1, found);
    points_.push_back(point);
    return result.answers;
  }

  const CurveWorkload& work_;
  ContinuousWorkspace workspace_;
  std::vector<CurvePoint> points_;
  Score score_;
};

inline int errorPart(const CurveFiles& files) {
  std::printf("## Error of the first contact\n\n");
  std::vector<CurvePoint> points;
  Score total;
  for (const CurveWorkload& work : curveWorkloads()) {
    CurveRun run(work);
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) run.swept(tolerance);
#ifdef SWEPT_HAS_FCL
    for (const int samples : {10, 30, 100, 300, 1000}) run.naive(samples);
#endif
    points.insert(points.end(), run.points().begin(), run.points().end());
    total += run.score();
  }
  const MarkdownTable table({"workload", "library", "tolerance, m, or samples", "mean error, m",
                             "largest, m", "mean, us", "missed contacts"});
  for (const CurvePoint& point : points)
    table.row({point.workload, point.contestant, point.setting(), number(point.meanError, 2),
               number(point.maxError, 2), number(point.meanMicroseconds),
               std::to_string(point.missed)});
  std::printf("\nswept: %d of %d right, %d late by more than the tolerance, %d unsound times\n\n",
              total.right(), total.sweeps, total.late, total.unsound);
  if (!files.csv.empty()) writeCurvesCsv(files.csv, points);
  if (!files.svg.empty()) writeCurvesSvg(files.svg, points);
  return total.wrong();
}

}  // namespace swept::benchmark
