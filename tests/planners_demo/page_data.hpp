// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "program.hpp"

/// Reads the numbers of a page as its scripts do.
namespace swept::test {

/// What is between `begin` and the next `end`.
std::string between(const std::string& text, const std::string& begin, const std::string& end);

/// The data of a page; fails the test when there is none.
nlohmann::json pageData(const std::string& html);

std::vector<std::uint8_t> bytesOf(const std::string& base64);
std::vector<float> floats(const std::string& base64);
std::vector<std::int32_t> integers(const std::string& base64);
std::vector<std::uint16_t> uint16s(const std::string& base64);

/// Pose number `index` of packed ones.
Eigen::Isometry3d poseOf(const std::vector<float>& numbers, std::size_t index);

/// The pose of a link at a frame of the page.
Eigen::Isometry3d linkPose(const nlohmann::json& data, std::size_t frame, const std::string& link);

/// False: the program was built without three.js.
bool programHasPages();

}  // namespace swept::test
