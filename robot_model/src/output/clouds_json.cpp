// SPDX-License-Identifier: BSD-3-Clause
#include "output/clouds_json.hpp"

#include "text/escaped_text.hpp"

namespace swept {

std::string cloudsText(const World& world) {
  std::string text;
  forEachCloud(world, [&](const WorldBody& body, const PointCloud& cloud, auto boxes) {
    text += "body " + escapedLine(body.name) + " is " + countedText(cloud.points().size(), "ball") +
            " of radius " + shortNumber(cloud.leastRadius());
    if (cloud.largestRadius() > cloud.leastRadius())
      text += " to " + shortNumber(cloud.largestRadius());
    text += " m";
    if (boxes > 0) text += " and " + countedText(boxes, "box", "boxes");
    text += "\n";
  });
  return text;
}

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
