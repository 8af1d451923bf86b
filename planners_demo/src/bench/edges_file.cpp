// SPDX-License-Identifier: BSD-3-Clause
#include "bench/edges_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string_view>

#include "output/text_output.hpp"

namespace swept {
namespace {

/// zlib passes what is not compressed through as it is.
std::string contents(const std::string& file) {
  if (!std::filesystem::exists(file)) throw InputError(file, 0, "file not found");
  if (!std::filesystem::is_regular_file(file)) throw InputError(file, 0, "not a regular file");
  std::unique_ptr<gzFile_s, int (*)(gzFile)> stream(gzopen(file.c_str(), "rb"), gzclose);
  if (!stream) throw InputError(file, 0, "file cannot be read");
  std::string text;
  std::array<char, 1 << 16> buffer;
  int count = 0;
  while ((count = gzread(stream.get(), buffer.data(), buffer.size())) > 0)
    text.append(buffer.data(), static_cast<std::size_t>(count));
  int error = Z_OK;
  const std::string reason = gzerror(stream.get(), &error);
  if (count < 0) throw InputError(file, 0, "file cannot be read: " + reason);
  // A compressed file that ends early is told of only at the end.
  if (error != Z_OK || gzclose(stream.release()) != Z_OK)
    throw InputError(file, 0, "the compressed data ends too early");
  return text;
}

std::vector<std::string> cellsOf(std::string_view line) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  for (std::size_t comma; (comma = line.find(',', begin)) != std::string_view::npos;
       begin = comma + 1)
    cells.emplace_back(line.substr(begin, comma - begin));
  cells.emplace_back(line.substr(begin));
  return cells;
}

std::vector<std::string> columnNames(int dimension) {
  std::vector<std::string> names{"set", "index"};
  for (const char* end : {"from", "to"})
    for (int i = 0; i < dimension; ++i) names.push_back(end + std::to_string(i));
  names.emplace_back("length");
  return names;
}

class EdgesReader {
 public:
  EdgesReader(const std::string& file, int dimension, const ProblemFile& problems)
      : file_(file), dimension_(static_cast<std::size_t>(dimension)), problems_(problems) {
    for (const std::string& set : problems.sets()) {
      const std::vector<int> indices = problems.indices(set);
      known_[set].insert(indices.begin(), indices.end());
    }
  }

  std::vector<BenchEdge> read() {
    const std::string text = contents(file_);
    if (text.empty()) throw InputError(file_, 0, "the file is empty");
    std::vector<BenchEdge> edges;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      std::string_view line(text.data() + begin, end - begin);
      begin = end + 1;
      ++line_;
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (line_ == 1)
        checkHeader(line);
      else if (!line.empty())
        edges.push_back(edge(line));
    }
    if (edges.empty()) throw InputError(file_, 0, "there are no edges in the file");
    return edges;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_, line_, message);
  }

  void checkHeader(std::string_view line) const {
    const std::vector<std::string> names = columnNames(static_cast<int>(dimension_));
    if (cellsOf(line) != names)
      fail("the header is '" + std::string(line) + "'; for a group of " +
           std::to_string(dimension_) + " variables it must be '" + joined(names, ",") + "'");
  }

  double number(const std::string& cell, const std::string& column) const {
    double value = 0.0;
    const char* end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    if (stop != end || error != std::errc() || !std::isfinite(value))
      fail(column + " is '" + cell + "'; it must be a finite number");
    return value;
  }

  /// The problem file's own words for what it does not have.
  void checkProblem(const std::string& set, int index) const {
    const auto found = known_.find(set);
    if (found != known_.end() && found->second.contains(index)) return;
    try {
      problems_.problem(set, index);
    } catch (const InputError& error) {
      fail(error.message() + " (" + error.file() + ")");
    }
  }

  BenchEdge edge(std::string_view line) const {
    const std::vector<std::string> cells = cellsOf(line);
    const std::size_t columns = 2 * dimension_ + 3;
    if (cells.size() != columns)
      fail(std::to_string(cells.size()) + " columns; it must be " + std::to_string(columns) +
           ", as in the header");
    BenchEdge edge;
    edge.set = cells[0];
    const char* end = cells[1].data() + cells[1].size();
    const auto [stop, error] = std::from_chars(cells[1].data(), end, edge.index);
    if (stop != end || error != std::errc())
      fail("index is '" + cells[1] + "'; it must be a whole number");
    checkProblem(edge.set, edge.index);
    for (std::size_t i = 0; i < dimension_; ++i) {
      edge.from.push_back(number(cells[2 + i], "from" + std::to_string(i)));
      edge.to.push_back(number(cells[2 + dimension_ + i], "to" + std::to_string(i)));
    }
    edge.length = number(cells.back(), "length");
    if (edge.length < 0.0) fail("length is '" + cells.back() + "'; it must be 0 or more");
    return edge;
  }

  const std::string& file_;
  std::size_t dimension_;
  const ProblemFile& problems_;
  std::map<std::string, std::set<int>> known_;
  int line_ = 0;
};

}  // namespace

std::vector<BenchEdge> readBenchEdges(const std::string& file, int dimension,
                                      const ProblemFile& problems) {
  return EdgesReader(file, dimension, problems).read();
}

}  // namespace swept
