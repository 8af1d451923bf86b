// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "timing.hpp"

/// Error against time: as a table for other programs, and as a picture.
namespace swept::benchmark {

struct CurvePoint {
  std::string workload, contestant;
  double tolerance = 0.0;  ///< m; 0 where there are samples instead
  int samples = 0;
  double meanError = 0.0;  ///< m
  double maxError = 0.0;   ///< m
  double meanMicroseconds = 0.0;
  int missed = 0;  ///< contacts said to be free; not part of the errors

  std::string setting() const {
    return samples > 0 ? std::to_string(samples) : number(tolerance, 1);
  }
};

inline std::ofstream openForWriting(const std::string& file) {
  std::ofstream stream(file);
  if (!stream) throw std::runtime_error(file + ": cannot be written");
  return stream;
}

inline void writeCurvesCsv(const std::string& file, const std::vector<CurvePoint>& points) {
  std::ofstream stream = openForWriting(file);
  stream << "workload,library,tolerance_m,samples,mean_error_m,max_error_m,mean_us,missed\n";
  for (const CurvePoint& point : points) {
    stream << '"' << point.workload << "\"," << point.contestant << ','
           << (point.samples > 0 ? "," + point.setting() : point.setting() + ",") << ','
           << number(point.meanError, 6) << ',' << number(point.maxError, 6) << ','
           << number(point.meanMicroseconds, 6) << ',' << point.missed << '\n';
  }
}

/// A panel for each workload, all with the same logarithmic axes.
class CurvePicture {
 public:
  explicit CurvePicture(const std::vector<CurvePoint>& points) : points_(points) {
    for (const CurvePoint& point : points)
      if (workloads_.empty() || workloads_.back() != point.workload)
        workloads_.push_back(point.workload);
    for (const CurvePoint& point : points) {
      left_ = std::min(left_, std::floor(std::log10(point.meanMicroseconds)));
      right_ = std::max(right_, std::ceil(std::log10(point.meanMicroseconds)));
      low_ = std::min(low_, std::floor(log10OfError(point)));
    }
  }

  std::string text() {
    const int panels = static_cast<int>(workloads_.size()) + 1;  // the last is the key
    const int rows = (panels + kColumns - 1) / kColumns;
    const int width = kColumns * kPanel + kMargin, height = rows * kPanel + kMargin;
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\""
         << height << "\" viewBox=\"0 0 " << width << ' ' << height
         << "\" font-family=\"sans-serif\" font-size=\"11\" fill=\"#333333\">\n<rect width=\""
         << width << "\" height=\"" << height << "\" fill=\"#ffffff\"/>\n";
    for (int i = 0; i + 1 < panels; ++i) {
      x0_ = kMargin + i % kColumns * kPanel;
      y0_ = kTitle + i / kColumns * kPanel;
      panel(workloads_[static_cast<std::size_t>(i)]);
    }
    x0_ = kMargin + (panels - 1) % kColumns * kPanel;
    y0_ = kTitle + (panels - 1) / kColumns * kPanel;
    key();
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  static constexpr int kColumns = 4;
  static constexpr int kPanel = 250, kSide = 180, kMargin = 30, kTitle = 30;
  static constexpr const char* kOurs = "#1f5fa8";
  static constexpr const char* kTheirs = "#c8571b";

  /// Errors below rounding are drawn there.
  static double log10OfError(const CurvePoint& point) {
    return std::log10(std::max(1e-12, point.meanError));
  }
  double x(const CurvePoint& point) const {
    return x0_ + 20 + kSide * (std::log10(point.meanMicroseconds) - left_) / (right_ - left_);
  }
  double y(const CurvePoint& point) const {
    return y0_ + kSide * (high_ - log10OfError(point)) / (high_ - low_);
  }
  void line(double x1, double y1, double x2, double y2, const char* colour, double width) {
    out_ << "<line x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\"" << y2
         << "\" stroke=\"" << colour << "\" stroke-width=\"" << width << "\"/>\n";
  }
  void label(double px, double py, const char* anchor, const std::string& words,
             const char* more = "") {
    out_ << "<text x=\"" << px << "\" y=\"" << py << "\" text-anchor=\"" << anchor << "\" " << more
         << '>' << words << "</text>\n";
  }
  static std::string power(double exponent) {
    std::ostringstream text;
    text << "10<tspan dy=\"-4\" font-size=\"8\">" << exponent << "</tspan>";
    return text.str();
  }

  void panel(const std::string& workload) {
    const double left = x0_ + 20, right = left + kSide, bottom = y0_ + kSide;
    for (double e = low_; e <= high_; ++e) {
      const double py = y0_ + kSide * (high_ - e) / (high_ - low_);
      line(left, py, right, py, "#e4e4e4", 1);
      if (static_cast<int>(e - low_) % 2 == 0) label(left - 5, py + 4, "end", power(e));
    }
    for (double e = left_; e <= right_; ++e) {
      const double px = left + kSide * (e - left_) / (right_ - left_);
      line(px, y0_, px, bottom, "#e4e4e4", 1);
      label(px, bottom + 15, "middle", power(e));
    }
    line(left, bottom, right, bottom, "#888888", 1);
    line(left, y0_, left, bottom, "#888888", 1);
    label((left + right) / 2, y0_ - 9, "middle", workload, "font-weight=\"bold\"");
    label((left + right) / 2, bottom + 31, "middle", "mean time, µs");
    std::ostringstream turned;
    constexpr int kHalf = kSide / 2;
    turned << "transform=\"rotate(-90 " << x0_ - 18 << ' ' << y0_ + kHalf << ")\"";
    label(x0_ - 18, y0_ + kHalf, "middle", "mean error, m", turned.str().c_str());
    curve(workload, "swept", kOurs);
    curve(workload, "FCL", kTheirs);
  }

  void marker(double px, double py, const char* colour, bool hollow) {
    out_ << "<circle cx=\"" << px << "\" cy=\"" << py << "\" r=\"3.5\" fill=\""
         << (hollow ? "#ffffff" : colour) << "\" stroke=\"" << colour
         << "\" stroke-width=\"1.5\"/>\n";
  }

  void curve(const std::string& workload, const std::string& contestant, const char* colour) {
    std::vector<const CurvePoint*> mine;
    for (const CurvePoint& point : points_)
      if (point.workload == workload && point.contestant == contestant) mine.push_back(&point);
    if (mine.empty()) return;
    out_ << "<polyline fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"1.5\" points=\"";
    for (const CurvePoint* point : mine) out_ << x(*point) << ',' << y(*point) << ' ';
    out_ << "\"/>\n";
    for (const CurvePoint* point : mine) marker(x(*point), y(*point), colour, point->missed > 0);
    // Ours from below its line, theirs from above: the upper left ends are often close together.
    const std::string fill = std::string("font-size=\"9\" fill=\"") + colour + '"';
    const double above = contestant == "swept" ? 12.0 : -7.0;
    label(x(*mine.front()) - 5, y(*mine.front()) + above, "end", mine.front()->setting(),
          fill.c_str());
    label(x(*mine.back()) + 6, y(*mine.back()) + 12, "start", mine.back()->setting(), fill.c_str());
  }

  void key() {
    const double left = x0_ + 20;
    double row = y0_ + 20;
    const auto entry = [&](const char* colour, bool hollow, const std::string& words) {
      line(left, row - 4, left + 24, row - 4, colour, 1.5);
      marker(left + 12, row - 4, colour, hollow);
      label(left + 32, row, "start", words);
      row += 20;
    };
    entry(kOurs, false, "swept, by tolerance (m)");
    entry(kTheirs, false, "FCL, by number of samples");
    entry(kTheirs, true, "some contacts missed");
    row += 6;
    for (const char* words : {"Error: how far the fastest point", "moves between the true first",
                              "contact and the one found; for", "swept, the farther end of its",
                              "bracket. Missed ones not counted."}) {
      label(left, row, "start", words);
      row += 15;
    }
  }

  const std::vector<CurvePoint>& points_;
  std::vector<std::string> workloads_;
  std::ostringstream out_;
  double left_ = 0.0, right_ = 1.0, low_ = -8.0, high_ = 0.0;  ///< decades
  int x0_ = 0, y0_ = 0;                                        ///< of the panel being drawn
};

inline void writeCurvesSvg(const std::string& file, const std::vector<CurvePoint>& points) {
  openForWriting(file) << CurvePicture(points).text();
}

}  // namespace swept::benchmark
