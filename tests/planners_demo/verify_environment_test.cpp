// SPDX-License-Identifier: BSD-3-Clause
// The checker of proofs says the same in every floating-point environment of its caller.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "gantry.hpp"
#include "transcript.hpp"
#include "verify/check.hpp"

namespace swept::test {
namespace {

using Json = nlohmann::ordered_json;

/// With a plane whose direction is as short, and whose bound is `share` of what it was.
Json changed(Json path, double length, double share) {
  Json& pair = path["proof"]["segments"][0]["pairs"][0];
  Json& plane = pair["intervals"][0][2];
  Eigen::Vector3d direction(plane[0].get<double>(), plane[1].get<double>(), plane[2].get<double>());
  direction *= length / direction.norm();
  for (std::size_t i = 0; i < 3; ++i) plane[i] = direction[static_cast<int>(i)];
  plane[3] = share * plane[3].get<double>();
  pair["digest"] = verify::pairDigest(pair);
  return path;
}

TEST(VerifyEnvironment, IsTheDefault) {
  const Gantry gantry;
  const std::string file = gantry.folder().path("path.json");
  ASSERT_EQ(gantry.run("plan", {"left", "right", "--embed", "-o", file}).exitCode, 0);
  const Json path = Json::parse(gantry.folder().read("path.json"));
  std::vector<Query> proven, refused;
  for (const double length : {1.0, 1.0 / 3.0, 2.6e-162, 3e-310}) {
    const std::string name = "length " + std::to_string(std::log10(length));
    const Json good = changed(path, length, 1.0 - 1e-9), bad = changed(path, length, 1.1);
    proven.push_back({name, [=](Transcript& t) {
                        const verify::Summary summary = verify::checkProof(good, good["model"]);
                        t.add(summary.clearance, summary.segments, summary.pairs, summary.intervals,
                              summary.planes);
                      }});
    refused.push_back({name, [=](Transcript&) { verify::checkProof(bad, bad["model"]); }});
  }
  expectSameInEveryEnvironment(proven);
  expectSameRefusals(refused);
}

}  // namespace
}  // namespace swept::test
