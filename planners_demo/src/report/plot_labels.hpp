// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace swept {

/// Finds places for labels beside points, so that none is on another or on a point. In px, y down.
class LabelPlacer {
 public:
  struct Place {
    double x, y;  ///< left end of the base line
  };

  LabelPlacer(double width, double height) : width_(width), height_(height) {}

  void keepClear(double x, double y) { taken_.push_back({x - 5, y - 5, x + 5, y + 5}); }

  /// None: all places around the point are taken.
  std::optional<Place> place(double x, double y, const std::string& text) {
    const double w = kCharacter * static_cast<double>(text.size());
    const std::array<Place, 6> candidates{{{x + 7, y - 5},
                                           {x + 7, y + 13},
                                           {x - w - 7, y - 5},
                                           {x - w - 7, y + 13},
                                           {x - w / 2, y - 10},
                                           {x - w / 2, y + 18}}};
    for (const Place& place : candidates) {
      const Rectangle wanted{place.x, place.y - 9, place.x + w, place.y + 2};
      if (!isFree(wanted)) continue;
      taken_.push_back(wanted);
      return place;
    }
    return {};
  }

 private:
  static constexpr double kCharacter = 6.3;  // of 11 px text

  struct Rectangle {
    double left, top, right, bottom;
  };

  bool isFree(const Rectangle& r) const {
    if (r.left < 0 || r.top < 0 || r.right > width_ || r.bottom > height_) return false;
    return std::ranges::none_of(taken_, [&](const Rectangle& other) {
      return r.left < other.right && other.left < r.right && r.top < other.bottom &&
             other.top < r.bottom;
    });
  }

  double width_, height_;
  std::vector<Rectangle> taken_;
};

}  // namespace swept
