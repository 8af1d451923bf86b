// SPDX-License-Identifier: BSD-3-Clause
#include "page_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace swept::test {

std::vector<std::uint8_t> bytesOf(const std::string& base64) {
  static const std::string kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned held = 0, bits = 0;
  for (const char c : base64) {
    if (c == '=') break;
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string::npos) throw std::runtime_error("not base64");
    held = held << 6 | static_cast<unsigned>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::uint8_t>(held >> bits));
    held &= (1u << bits) - 1u;
  }
  return bytes;
}

namespace {

template <typename Number>
std::vector<Number> numbersOf(const std::string& base64) {
  const std::vector<std::uint8_t> bytes = bytesOf(base64);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

}  // namespace

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return {};
  const std::size_t start = from + begin.size();
  return text.substr(start, text.find(end, start) - start);
}

nlohmann::json pageData(const std::string& html) {
  const std::string text =
      between(html, "<script id=\"data\" type=\"application/json\">", "</script>");
  nlohmann::json data = nlohmann::json::parse(text, nullptr, false);
  EXPECT_TRUE(data.is_object()) << "no data in a page of " << html.size() << " bytes";
  return data;
}

std::vector<float> floats(const std::string& base64) {
  return numbersOf<float>(base64);
}

std::vector<std::int32_t> integers(const std::string& base64) {
  return numbersOf<std::int32_t>(base64);
}

std::vector<std::uint16_t> uint16s(const std::string& base64) {
  return numbersOf<std::uint16_t>(base64);
}

Eigen::Isometry3d poseOf(const std::vector<float>& numbers, std::size_t index) {
  const float* n = &numbers.at(7 * index + 6) - 6;
  const Eigen::Quaterniond turn(n[6], n[3], n[4], n[5]);
  return Eigen::Translation3d(n[0], n[1], n[2]) * turn.normalized();
}

Eigen::Isometry3d linkPose(const nlohmann::json& data, std::size_t frame, const std::string& link) {
  const auto links = data["frames"]["links"].get<std::vector<std::string>>();
  const auto place = static_cast<std::size_t>(std::ranges::find(links, link) - links.begin());
  return poseOf(floats(data["frames"]["poses"]), frame * links.size() + place);
}

bool programHasPages() {
  return runSwept({"plan", "--help"}).out.find("--html") != std::string::npos;
}

}  // namespace swept::test
