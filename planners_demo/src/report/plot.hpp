// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace swept {

struct PlotPoint {
  double x = 0.0;     ///< > 0
  double y = 0.0;     ///< >= 0
  std::string label;  ///< beside the point
  std::string title;  ///< under the pointer
};

/// Points that a line connects in their order.
struct PlotSeries {
  std::string name;
  int style = 0;  ///< 0, 1 or 2: colour and marker
  std::vector<PlotPoint> points;
};

/// An error against the time it takes. Both axes are logarithmic; errors of 0, or below rounding,
/// have a line of their own below the others.
struct Plot {
  enum class Unit { Share, Metres };
  std::string title;
  std::string yLabel;
  Unit unit = Unit::Share;  ///< of y; x is in ns
  std::vector<PlotSeries> series;
};

/// An SVG element with its own colours for light and dark, to be a file or part of a page. Each
/// point is one element of class `point`.
std::string svgText(const Plot& plot);

}  // namespace swept
