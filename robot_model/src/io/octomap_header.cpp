// SPDX-License-Identifier: BSD-3-Clause
#include "io/octomap_header.hpp"

#include "text/numbers.hpp"

namespace swept::detail {

namespace {

/// m. With these, no coordinate of a map overflows or is lost to rounding.
constexpr double kLeastResolution = 1e-9;
constexpr double kMostResolution = 1e6;

class HeaderReader {
 public:
  explicit HeaderReader(LineReader& lines) : lines_(lines) {}
  OctomapHeader read(OctomapForm form);

 private:
  void readFirst(OctomapForm form);
  void readEntry(const std::vector<std::string_view>& line);
  void readId(std::string_view id);
  void readResolution(std::string_view text);
  void readSize(std::string_view text);
  void requireAll() const;

  LineReader& lines_;
  OctomapHeader header_;
  bool idKnown_ = false;
  bool resolutionKnown_ = false;
  bool sizeKnown_ = false;
};

void HeaderReader::readFirst(OctomapForm form) {
  const std::string_view expected =
      form == OctomapForm::Binary ? "# Octomap OcTree binary file" : "# Octomap OcTree file";
  if (!lines_.next() || !lines_.line().starts_with(expected)) {
    lines_.fail("the first line is " + shown(lines_.line()) + "; it must be '" +
                std::string(expected) + "'");
  }
}

void HeaderReader::readId(std::string_view id) {
  if (id != "OcTree" && id != "ColorOcTree") {
    lines_.fail("id is " + shown(id) + "; allowed are OcTree and ColorOcTree");
  }
  header_.hasColors = id == "ColorOcTree";
  idKnown_ = true;
}

void HeaderReader::readResolution(std::string_view text) {
  const auto value = parseNumber(text);
  if (!value || !(*value >= kLeastResolution && *value <= kMostResolution)) {
    lines_.fail("res is " + shown(text) + "; it must be a number from " +
                formatNumber(kLeastResolution) + " to " + formatNumber(kMostResolution));
  }
  header_.resolution = *value;
  resolutionKnown_ = true;
}

void HeaderReader::readSize(std::string_view text) {
  const auto value = parseCount(text);
  if (!value) lines_.fail("size is " + shown(text) + "; it must be a whole number from 0 to 9e15");
  header_.nodes = *value;
  sizeKnown_ = true;
}

void HeaderReader::readEntry(const std::vector<std::string_view>& line) {
  const std::string name(line[0]);
  if (name != "id" && name != "res" && name != "size") {
    lines_.fail("unknown entry " + shown(name) +
                " of an OctoMap header; allowed are id, res, size and data");
  }
  if (line.size() != 2) lines_.fail(name + " must have one value behind it");
  if (name == "id" ? idKnown_ : name == "res" ? resolutionKnown_ : sizeKnown_) {
    lines_.fail("a second entry " + name + "; one is allowed");
  }
  if (name == "id") readId(line[1]);
  if (name == "res") readResolution(line[1]);
  if (name == "size") readSize(line[1]);
}

void HeaderReader::requireAll() const {
  if (!idKnown_) lines_.fail("the header has no entry id");
  if (!resolutionKnown_) lines_.fail("the header has no entry res");
  if (!sizeKnown_) lines_.fail("the header has no entry size");
}

OctomapHeader HeaderReader::read(OctomapForm form) {
  readFirst(form);
  while (lines_.nextFilled()) {
    const std::vector<std::string_view> line = words(lines_.line());
    if (line[0].front() == '#') continue;
    if (line[0] == "data") {
      requireAll();
      return header_;
    }
    readEntry(line);
  }
  lines_.fail("the file ends where an entry data of its header should follow");
}

}  // namespace

OctomapHeader readOctomapHeader(LineReader& lines, OctomapForm form) {
  return HeaderReader(lines).read(form);
}

}  // namespace swept::detail
