// SPDX-License-Identifier: BSD-3-Clause
#include "replay/flat_terrain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

namespace swept {
namespace {

/// Takes pieces off the front of a text, which is `ok` as long as they were there.
class Pieces {
 public:
  explicit Pieces(const std::string& text) : rest_(text) {}

  void skip(std::string_view piece) {
    if (!rest_.starts_with(piece)) return fail();
    rest_.remove_prefix(piece.size());
  }
  /// Finite.
  double number() {
    const std::string digits = takeAllOf("+-.0123456789eE");
    char* end = nullptr;
    const double value = std::strtod(digits.c_str(), &end);
    if (digits.empty() || *end != '\0' || !std::isfinite(value)) fail();
    return value;
  }
  /// Of no more than four digits.
  int count() {
    const std::string digits = takeAllOf("0123456789");
    if (digits.empty() || digits.size() > 4) fail();
    return ok_ ? std::stoi(digits) : 0;
  }
  bool ok() const { return ok_; }
  bool atEnd() const { return rest_.empty(); }

 private:
  std::string takeAllOf(const char* characters) {
    const std::size_t end = std::min(rest_.find_first_not_of(characters), rest_.size());
    std::string taken(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return taken;
  }
  void fail() { ok_ = false; }

  std::string_view rest_;
  bool ok_ = true;
};

}  // namespace

Terrain readFlatTerrain(const JsonValue& place) {
  constexpr std::size_t kLongest = 200;    // characters: others are not worth a line of a message
  constexpr int kMostSamples = 1'000'000;  // a mesh of them takes seconds, and 0.6 GB
  const std::string wanted = "rows of numbers, or 'flat, all H, RxC samples, base B'";
  const std::string text = place.text();
  if (text.size() > kLongest)
    place.fail("is a text of " + std::to_string(text.size()) + " characters; it must be " + wanted);
  Pieces pieces(text);
  pieces.skip("flat, all ");
  const double height = pieces.number();
  pieces.skip(", ");
  const int rows = pieces.count();
  pieces.skip("x");
  const int columns = pieces.count();
  pieces.skip(" samples, base ");
  const double base = pieces.number();
  if (!pieces.ok() || !pieces.atEnd()) place.refuse(wanted);
  if (rows * columns > kMostSamples)
    place.fail("has " + std::to_string(rows) + "x" + std::to_string(columns) +
               " samples; it may have " + std::to_string(kMostSamples) + " in all");
  return {Eigen::MatrixXd::Constant(rows, columns, height), base};
}

}  // namespace swept
