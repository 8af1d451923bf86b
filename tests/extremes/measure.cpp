// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "pair_judge.hpp"
#include "row.hpp"
#include "sample.hpp"
#include "stiff.hpp"

namespace extremes {

namespace {

Row rowOf(const std::string& query, const PairCase& from) {
  Row row;
  row.query = query;
  row.name = from.name;
  row.baseline = from.baseline;
  row.workLimit = from.workLimit;
  row.bothSides = from.bothSides;
  return row;
}

void measure(const PairCase& from, std::vector<Row>& rows) {
  Random random(seedOf(from.name));
  Row collide = rowOf("collide", from);
  collide.countsWork = collide.hasBound = false;
  Row distance = rowOf("distance", from);
  Row signedDistance = rowOf("signedDistance", from);
  Row continuous = rowOf("continuousCollide", from);
  continuous.bothSides = true;
  continuous.workLimit = from.motionWorkLimit;
  for (int i = 0; i < from.samples; ++i) {
    const Sample sample = from.draw(random, i);
    collide.add(judgeCollide(sample));
    distance.add(judgeDistance(sample));
    signedDistance.add(judgeSignedDistance(sample));
    if (const auto answer = judgeContinuous(sample, random)) continuous.add(*answer);
  }
  rows.push_back(std::move(collide));
  rows.push_back(std::move(distance));
  rows.push_back(std::move(signedDistance));
  if (continuous.n > 0) rows.push_back(std::move(continuous));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void compare(std::vector<Row>& rows) {
  std::map<std::pair<std::string, std::string>, const Row*> byName;
  for (const Row& row : rows) byName[{row.query, row.name}] = &row;
  for (Row& row : rows) {
    const Row& ordinary = *byName.at({row.query, row.baseline});
    row.timeRatio = median(row.seconds) / median(ordinary.seconds);
    row.workRatio = static_cast<double>(row.work) /
                    static_cast<double>(std::max<std::int64_t>(1, ordinary.work));
  }
}

}  // namespace

std::vector<Row> measured() {
  std::vector<Row> rows;
  for (const auto& group : {scaleCases(), gapCases(), parallelCases(), sliverCases(), nestedCases(),
                            hullCases(), rotationCases()}) {
    for (const PairCase& one : group) measure(one, rows);
  }
  stiffRows(rows);
  compare(rows);
  return rows;
}

}  // namespace extremes
