// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <bit>
#include <cmath>
#include <string>

#include "io/octomap_header.hpp"
#include "io/point_file.hpp"
#include "io/scalar.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/cloud_file.hpp"

namespace swept {

namespace detail {

namespace {

constexpr int kLevels = 16;  ///< below the root; OctoMap's trees have no more

/// A cube of the tree, by its index among 2^depth along each axis, counted from the middle of the
/// map.
struct Cell {
  std::array<int, 3> index{};
  int depth = 0;
};

Cell childOf(const Cell& cell, int child) {
  Cell result{cell.index, cell.depth + 1};
  // Below the root, cells left of the middle have negative indices.
  const int shift = cell.depth == 0 ? 1 : 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.index[axis] = 2 * cell.index[axis] + (child >> axis & 1) - shift;
  }
  return result;
}

/// Walks the nodes in the order of the file, children by ascending number, depth first.
class TreeReader {
 public:
  TreeReader(const PointFile& file, std::size_t begin, const OctomapHeader& header)
      : file_(file), at_(begin), header_(header) {}
  OccupancyMap read(OctomapForm form);

 private:
  enum class Node : std::uint8_t { Absent, Free, Occupied, Inner };
  /// An inner node, some of whose children are still to be looked at.
  struct Open {
    Cell cell;
    std::array<Node, 8> children{};  ///< Full: Inner stands for any that is there
    int next = 0;
  };

  void readChild(OctomapForm form, const Cell& cell, Node node);
  void openBinary(const Cell& cell);
  void readFull(const Cell& cell);
  void push(const Open& open, std::size_t offset);
  void addOccupied(const Cell& cell);
  const char* take(std::size_t count);

  const PointFile& file_;
  std::size_t at_;
  const OctomapHeader& header_;
  std::uint64_t nodes_ = 0;
  std::array<Open, kLevels> open_;
  std::size_t depth_ = 0;  ///< so many of open_ are in use
  OccupancyMap map_{};
};

const char* TreeReader::take(std::size_t count) {
  if (file_.bytes().size() - at_ < count) {
    file_.failAt(
        at_, "the file ends within its nodes; the header says " + std::to_string(header_.nodes));
  }
  at_ += count;
  return file_.bytes().data() + at_ - count;
}

void TreeReader::addOccupied(const Cell& cell) {
  if (map_.occupied.size() == kMaxPoints) {
    file_.failAt(at_, "there are more than " + std::to_string(kMaxPoints) +
                          " occupied cubes, which is the most allowed");
  }
  OccupancyMap::Cube cube;
  cube.side = std::ldexp(header_.resolution, kLevels - cell.depth);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // The root is the only cell that has the origin in its middle.
    const double middle = cell.depth == 0 ? 0.0 : cell.index[axis] + 0.5;
    cube.center[static_cast<Eigen::Index>(axis)] = middle * cube.side;
  }
  map_.occupied.push_back(cube);
}

void TreeReader::push(const Open& open, std::size_t offset) {
  if (open.cell.depth == kLevels) {
    file_.failAt(offset, "a node has children below level " + std::to_string(kLevels) +
                             ", which is the last one");
  }
  open_[depth_++] = open;
}

/// Two bits for each child of an inner node.
void TreeReader::openBinary(const Cell& cell) {
  const std::size_t offset = at_;
  const unsigned bits = bytesAs<std::uint16_t>(take(2), std::endian::little);
  if (bits == 0) {
    // Not even OctoMap can tell what a root without children was. It counts as occupied.
    if (cell.depth == 0) return addOccupied(cell);
    file_.failAt(offset, "a node that should have children has none");
  }
  Open open{cell};
  for (std::size_t child = 0; child < 8; ++child) {
    open.children[child] = static_cast<Node>(bits >> 2 * child & 3u);
  }
  push(open, offset);
}

/// Log odds, a colour where the tree has colours, and a bit for each child.
void TreeReader::readFull(const Cell& cell) {
  const std::size_t offset = at_;
  const char* const bytes = take(header_.hasColors ? 8 : 5);
  const float logOdds = bytesAs<float>(bytes, std::endian::little);
  const unsigned bits = static_cast<unsigned char>(bytes[header_.hasColors ? 7 : 4]);
  if (std::isnan(logOdds)) file_.failAt(offset, "the log odds of a node are not a number");
  if (bits == 0) {
    if (logOdds >= 0.0f) addOccupied(cell);
    return;
  }
  Open open{cell};
  for (std::size_t child = 0; child < 8; ++child) {
    open.children[child] = (bits >> child & 1u) != 0 ? Node::Inner : Node::Absent;
  }
  push(open, offset);
}

void TreeReader::readChild(OctomapForm form, const Cell& cell, Node node) {
  if (node == Node::Absent) return;
  ++nodes_;
  if (node == Node::Occupied) addOccupied(cell);
  if (node == Node::Inner) form == OctomapForm::Full ? readFull(cell) : openBinary(cell);
}

OccupancyMap TreeReader::read(OctomapForm form) {
  map_.resolution = header_.resolution;
  if (header_.nodes > 0) readChild(form, {}, Node::Inner);
  while (depth_ > 0) {
    Open& open = open_[depth_ - 1];
    if (open.next == 8) {
      --depth_;
      continue;
    }
    const int child = open.next++;
    readChild(form, childOf(open.cell, child), open.children[static_cast<std::size_t>(child)]);
  }
  if (nodes_ != header_.nodes) {
    file_.failAt(at_, "the data end after " + std::to_string(nodes_) + " nodes; the header says " +
                          std::to_string(header_.nodes));
  }
  if (at_ < file_.bytes().size()) file_.failAt(at_, "more follows after the last node");
  return std::move(map_);
}

}  // namespace

}  // namespace detail

OccupancyMap loadOctomap(const std::filesystem::path& file, const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return loadOctomap(file, options); });
  }
  const std::string ending = detail::lowerEnding(file);
  if (ending != ".bt" && ending != ".ot") {
    throw InputError(file.string(), 0,
                     "unknown ending '" + file.extension().string() +
                         "' of an OctoMap file; allowed are .bt and .ot");
  }
  const auto form = ending == ".bt" ? detail::OctomapForm::Binary : detail::OctomapForm::Full;
  const detail::PointFile bytes(file, options);
  detail::LineReader lines(bytes);
  const detail::OctomapHeader header = detail::readOctomapHeader(lines, form);
  return detail::TreeReader(bytes, lines.offset(), header).read(form);
}

}  // namespace swept
