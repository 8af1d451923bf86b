// SPDX-License-Identifier: BSD-3-Clause
#include "report/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/markup_text.hpp"
#include "output/text_output.hpp"
#include "report/plot_labels.hpp"

namespace swept {
namespace {

constexpr double kWidth = 760, kHeight = 440;  // px, as all that follows
constexpr double kLeft = 84, kRight = 740, kTop = 72, kBottom = 382;
constexpr double kZeroRow = 26;  // between the axis and the lowest decade

constexpr double kRounding = 1e-12;  // smaller errors are drawn as none

constexpr const char* kPlotStyle =
    "<style>"
    ".plot{font:12px system-ui,\"DejaVu Sans\",sans-serif}"
    ".plot .back{fill:#fff}.plot text{fill:#1d2430}.plot .soft{fill:#667085}"
    ".plot .title{font-size:15px;font-weight:600}.plot .label{font-size:11px}"
    ".plot .grid{stroke:#dfe3e8}.plot .axis{stroke:#667085}"
    ".plot .curve{fill:none;stroke-width:1.8}.plot .point{stroke-width:1.5}"
    ".plot .s0{stroke:#2563a8}.plot .s1{stroke:#c8571b}.plot .s2{stroke:#2c8a66}"
    ".plot .point.s0{fill:#2563a8}.plot .point.s1{fill:#c8571b}.plot .point.s2{fill:#2c8a66}"
    "@media(prefers-color-scheme:dark){"
    ".plot .back{fill:#1c222b}.plot text{fill:#e6eaf0}.plot .soft{fill:#94a0b2}"
    ".plot .grid{stroke:#2d3643}.plot .axis{stroke:#94a0b2}"
    ".plot .s0{stroke:#79b0ea}.plot .s1{stroke:#f08a4b}.plot .s2{stroke:#4dbb8f}"
    ".plot .point.s0{fill:#79b0ea}.plot .point.s1{fill:#f08a4b}.plot .point.s2{fill:#4dbb8f}}"
    "</style>\n";

/// To a tenth of a pixel.
std::string px(double value) {
  return shortNumber(std::round(10.0 * value) / 10.0);
}

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + markupText(value) + "\"";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& kind) {
  return "<line" + attribute("x1", px(x1)) + attribute("y1", px(y1)) + attribute("x2", px(x2)) +
         attribute("y2", px(y2)) + attribute("class", kind) + "/>\n";
}

std::string words(double x, double y, const std::string& anchor, const std::string& kind,
                  const std::string& text, const std::string& more = {}) {
  return "<text" + attribute("x", px(x)) + attribute("y", px(y)) +
         attribute("text-anchor", anchor) + attribute("class", kind) + more + ">" +
         markupText(text) + "</text>\n";
}

/// `1 µs` of 1000 ns.
std::string timeText(double ns) {
  if (ns < 1e3) return shortNumber(ns) + " ns";
  if (ns < 1e6) return shortNumber(ns / 1e3) + " µs";
  if (ns < 1e9) return shortNumber(ns / 1e6) + " ms";
  return shortNumber(ns / 1e9) + " s";
}

/// Whole powers of ten that contain values.
struct Decades {
  int low = std::numeric_limits<int>::max();
  int high = std::numeric_limits<int>::min();

  void add(double value) {
    low = std::min(low, static_cast<int>(std::floor(std::log10(value))));
    high = std::max(high, static_cast<int>(std::ceil(std::log10(value))));
  }
  /// At least one of them, there where nothing was added.
  void complete(int otherwise) {
    if (low > high) low = high = otherwise;
    if (low == high) --low;
  }
  /// Where ticks are: at each power, and if there are few also at 2 and 5 times it.
  std::vector<double> ticks() const {
    constexpr int kFew = 2;
    std::vector<double> values;
    for (int e = low; e <= high; ++e) {
      for (const double factor : {1.0, 2.0, 5.0})
        if (factor == 1.0 || (high - low <= kFew && e < high))
          values.push_back(factor * std::pow(10.0, e));
    }
    return values;
  }
  /// In [0, 1].
  double place(double value) const { return (std::log10(value) - low) / (high - low); }
};

class Drawing {
 public:
  explicit Drawing(const Plot& plot) : plot_(plot) {
    for (const PlotSeries& series : plot.series) {
      for (const PlotPoint& point : series.points) {
        x_.add(point.x);
        if (point.y > kRounding) y_.add(point.y);
      }
    }
    x_.complete(4);
    y_.complete(plot.unit == Plot::Unit::Share ? 0 : -3);
  }

  std::string text() {
    out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\"" +
           attribute("viewBox", "0 0 " + px(kWidth) + " " + px(kHeight)) +
           attribute("width", px(kWidth)) + attribute("height", px(kHeight)) +
           " role=\"img\">\n<title>" + markupText(plot_.title) + "</title>\n" + kPlotStyle +
           "<rect" + attribute("width", px(kWidth)) + attribute("height", px(kHeight)) +
           " class=\"back\"/>\n" + words(kLeft, 26, "start", "title", plot_.title);
    axes();
    legend();
    for (const PlotSeries& series : plot_.series) curve(series);
    labels();
    return out_ + "</svg>\n";
  }

 private:
  double x(double value) const { return kLeft + (kRight - kLeft) * x_.place(value); }
  double y(double value) const {
    const double lowest = kBottom - kZeroRow;
    return value > kRounding ? lowest - (lowest - kTop) * y_.place(value) : kBottom;
  }

  std::string valueText(double value) const {
    return plot_.unit == Plot::Unit::Share ? shortNumber(100.0 * value) + " %"
                                           : shortNumber(value) + " m";
  }

  void axes() {
    for (const double value : y_.ticks()) {
      out_ += line(kLeft, y(value), kRight, y(value), "grid");
      out_ += words(kLeft - 8, y(value) + 4, "end", "soft", valueText(value));
    }
    for (const double value : x_.ticks()) {
      out_ += line(x(value), kTop, x(value), kBottom, "grid");
      out_ += words(x(value), kBottom + 18, "middle", "soft", timeText(value));
    }
    out_ += line(kLeft, kBottom, kRight, kBottom, "axis");
    out_ += line(kLeft, kTop, kLeft, kBottom, "axis");
    out_ += words(kLeft - 8, kBottom + 4, "end", "soft", "none");
    out_ +=
        words((kLeft + kRight) / 2, kBottom + 42, "middle", "soft", "mean time on the processor");
    const double middle = (kTop + kBottom) / 2;
    out_ += words(16, middle, "middle", "soft", plot_.yLabel,
                  attribute("transform", "rotate(-90 16 " + px(middle) + ")"));
  }

  void legend() {
    double left = kLeft;
    for (const PlotSeries& series : plot_.series) {
      out_ += line(left, 48, left + 22, 48, "curve s" + std::to_string(series.style));
      out_ += words(left + 28, 52, "start", "soft", series.name);
      left += 50 + 7.0 * static_cast<double>(series.name.size());
    }
  }

  void curve(const PlotSeries& series) {
    const std::string style = "s" + std::to_string(series.style);
    std::string path;
    for (const PlotPoint& point : series.points)
      path.append(path.empty() ? "" : " ").append(px(x(point.x)) + "," + px(y(point.y)));
    out_ += "<polyline" + attribute("points", path) + attribute("class", "curve " + style) + "/>\n";
    for (const PlotPoint& point : series.points) {
      out_ += marker(x(point.x), y(point.y), series.style) + attribute("class", "point " + style) +
              "><title>" + markupText(point.title) + "</title>" +
              (series.style == 0 ? "</circle>\n" : "</path>\n");
    }
  }

  /// An open tag: a circle, a square or a triangle.
  static std::string marker(double x, double y, int style) {
    if (style == 0) return "<circle" + attribute("cx", px(x)) + attribute("cy", px(y)) + " r=\"4\"";
    const std::string from = "M" + px(x - 4) + " " + px(y + (style == 1 ? -4 : 4));
    return "<path" + attribute("d", from + (style == 1 ? "h8v8h-8z" : "h8l-4 -8z"));
  }

  void labels() {
    LabelPlacer placer(kWidth, kBottom);
    for (const PlotSeries& series : plot_.series)
      for (const PlotPoint& point : series.points) placer.keepClear(x(point.x), y(point.y));
    for (const PlotSeries& series : plot_.series) {
      for (const PlotPoint& point : series.points) {
        const auto place = placer.place(x(point.x), y(point.y), point.label);
        if (place) out_ += words(place->x, place->y, "start", "label", point.label);
      }
    }
  }

  const Plot& plot_;
  Decades x_, y_;
  std::string out_;
};

}  // namespace

std::string svgText(const Plot& plot) {
  return Drawing(plot).text();
}

}  // namespace swept
