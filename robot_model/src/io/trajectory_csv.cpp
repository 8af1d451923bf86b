// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "io/csv_lines.hpp"
#include "io/trajectory_formats.hpp"

namespace swept::detail {

namespace {

constexpr std::string_view kVelocity = "_velocity";
constexpr std::string_view kAcceleration = "_acceleration";

/// Columns of one kind: where they are in a line, and whose they are.
struct KindOfColumns {
  std::vector<std::size_t> places;
  std::vector<std::string> names;  ///< of joints and variables

  void add(std::size_t place, std::string name) {
    places.push_back(place);
    names.push_back(std::move(name));
  }
};

class CsvTrajectory {
 public:
  CsvTrajectory(const InputSource& source, TrajectoryRows& rows) : source_(source), rows_(rows) {}

  void read(const std::string& text) {
    CsvLines lines(text);
    const FailAt fail = [&](const std::string& message) { source_.fail(lines.line(), message); };
    if (!lines.next())
      source_.fail(0, "it is empty; its first line must have 'time' and the names of the joints");
    setColumns(csvNames(lines.text(), fail), fail);
    while (lines.next()) {
      cells_ = csvValues(lines.text());
      rows_.add(point(fail), lines.line(), fail);
    }
    if (rows_.trajectories().back().points.empty())
      source_.fail(0, "it has no line of values below that of the names");
  }

 private:
  void setColumns(const std::vector<std::string>& names, const FailAt& fail) {
    requireCsvNames(names, fail);
    names_ = names;
    std::set<std::string> known;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!known.insert(names[i]).second)
        fail(csvColumn(i) + "is '" + names[i] + "' a second time");
      assign(i);
    }
    if (!time_) fail("there is no column 'time', which a trajectory needs");
    rows_.begin(positions_.names, failAtColumnOf(positions_, fail), fail);
    requirePositionsOf(velocities_, fail);
    if (!velocities_.names.empty())
      rows_.setVelocities(velocities_.names, failAtColumnOf(velocities_, fail), fail);
    requirePositionsOf(accelerations_, fail);
    if (!accelerations_.names.empty())
      rows_.setAccelerations(accelerations_.names, failAtColumnOf(accelerations_, fail), fail);
  }

  /// A joint's own name counts before that of another one's velocity.
  void assign(std::size_t i) {
    if (names_[i] == "time")
      time_ = i;
    else if (isKnown(names_[i]))
      positions_.add(i, names_[i]);
    else if (const auto joint = jointOf(names_[i], kVelocity))
      velocities_.add(i, *joint);
    else if (const auto other = jointOf(names_[i], kAcceleration))
      accelerations_.add(i, *other);
    else
      positions_.add(i, names_[i]);
  }

  bool isKnown(const std::string& name) const { return rows_.columns().knows(name); }

  std::optional<std::string> jointOf(const std::string& name, std::string_view ending) const {
    if (!name.ends_with(ending)) return std::nullopt;
    std::string joint = name.substr(0, name.size() - ending.size());
    if (!isKnown(joint)) return std::nullopt;
    return joint;
  }

  FailAtColumn failAtColumnOf(const KindOfColumns& columns, const FailAt& fail) const {
    return [this, &columns, &fail](std::size_t i, const std::string& message) {
      const std::size_t place = columns.places[i];
      const bool isOwnName = names_[place] == columns.names[i];
      fail(csvColumn(place, isOwnName ? "" : names_[place]) + message);
    };
  }

  void requirePositionsOf(const KindOfColumns& rates, const FailAt& fail) const {
    for (std::size_t i = 0; i < rates.names.size(); ++i)
      if (std::ranges::find(positions_.names, rates.names[i]) == positions_.names.end())
        fail(csvColumn(rates.places[i], names_[rates.places[i]]) + "needs a column '" +
             rates.names[i] + "'");
  }

  TrajectoryPoint point(const FailAt& fail) const {
    requireCsvCells(cells_.size(), names_.size(), fail);
    return {.time = number(*time_, fail),
            .positions = numbers(positions_, fail),
            .velocities = optionalNumbers(velocities_, fail),
            .accelerations = optionalNumbers(accelerations_, fail)};
  }

  double number(std::size_t i, const FailAt& fail) const {
    return csvNumber(cells_[i], i, names_[i], fail);
  }

  std::vector<double> numbers(const KindOfColumns& columns, const FailAt& fail) const {
    std::vector<double> values;
    for (const std::size_t place : columns.places) values.push_back(number(place, fail));
    return values;
  }

  /// None if all cells are empty.
  std::vector<double> optionalNumbers(const KindOfColumns& columns, const FailAt& fail) const {
    std::optional<std::size_t> empty, given;
    for (const std::size_t place : columns.places) {
      std::optional<std::size_t>& first = cells_[place].empty() ? empty : given;
      if (!first) first = place;
    }
    if (empty && given)
      fail(csvColumn(*empty, names_[*empty]) + "is empty, but " + names_[*given] +
           " is not; a line has all of them or none");
    return given ? numbers(columns, fail) : std::vector<double>();
  }

  const InputSource& source_;
  TrajectoryRows& rows_;
  std::vector<std::string> names_;
  std::optional<std::size_t> time_;  ///< its column
  KindOfColumns positions_, velocities_, accelerations_;
  std::vector<std::string_view> cells_;  ///< of the present line
};

}  // namespace

void readCsvTrajectory(const std::string& text, const InputSource& source, TrajectoryRows& rows) {
  CsvTrajectory(source, rows).read(text);
}

}  // namespace swept::detail
