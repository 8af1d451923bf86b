// SPDX-License-Identifier: BSD-3-Clause
#include "output/clouds_json.hpp"

namespace swept {

Json cloudsJson(const World& world) {
  Json clouds = Json::array();
  forEachCloud(world, [&](const WorldBody& body, const PointCloud& cloud, auto boxes) {
    clouds.push_back({{"body", body.name},
                      {"balls", cloud.points().size()},
                      {"least_radius", cloud.leastRadius()},
                      {"largest_radius", cloud.largestRadius()},
                      {"boxes", boxes}});
  });
  return clouds;
}

}  // namespace swept
