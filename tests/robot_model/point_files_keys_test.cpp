// SPDX-License-Identifier: BSD-3-Clause
// What becomes of each part of a file of points, as robot_model/FORMATS.md says.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "cloud_writers.hpp"
#include "format_table.hpp"
#include "input_files.hpp"
#include "swept/robot_model/cloud_file.hpp"

namespace swept {
namespace {

using test::KeyCase;
using test::walkFormat;
using Answer = std::function<std::string(const std::string&)>;

/// All that comes of a file with that ending.
Answer pointsOf(const std::string& ending) {
  return [ending](const std::string& text) {
    const test::TemporaryFolder folder;
    const SensedPoints sensed = loadSensedPoints(folder.write("a" + ending, text));
    std::ostringstream answer;
    answer.precision(17);
    for (const Eigen::Vector3d& point : sensed.points) answer << point.transpose() << '\n';
    answer << "from " << sensed.sensor.transpose();
    return answer.str();
  };
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(PointFilesKeys, Pcd) {
  const std::string pcd =
      "VERSION 0.7\nFIELDS x y z i\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n1 2 3 7\n4 5 6 8\n";
  const std::string old = "COLUMNS x y z\nPOINTS 1\nDATA ascii\n1 2 3\n";
  const std::string header = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA ";
  const std::string twelve = "1.25 2.5 -3\n";  // bytes, of a point either way
  const std::string counted =
      "FIELDS x i y z j\nSIZE 4 4 4 4 4\nTYPE F F F F F\nCOUNT 1 1 1 1 2\nPOINTS 1\nDATA ascii\n"
      "1 7 2 3 8 9\n";
  const auto padded = [](const std::string& size, const std::string& type) {
    return "FIELDS x y z\nSIZE " + size + "\nTYPE " + type +
           "\nCOUNT 1 1 1\nPOINTS 1\nDATA binary\n" + std::string(12, '\x40');
  };
  const auto change = [&](const std::string& key, const std::string& from, const std::string& to) {
    return KeyCase{key, pcd, replaced(pcd, from, to)};
  };
  walkFormat("Points: PCD",
             {change("#", "VERSION", "# VIEWPOINT 9 9 9 1 0 0 0\nVERSION"),
              change("VERSION", "0.7", ".6"),
              change("FIELDS", "x y z i", "i x y z"),
              change("FIELDS", "x y z i", "x y i z"),
              {"COLUMNS", old, replaced(old, "x y z", "z x y")},
              {"SIZE", padded("4 4 4", "F F F"), padded("4 4 8", "F F F") + std::string(4, '\x40')},
              {"TYPE", padded("4 4 4", "F F F"), padded("4 4 4", "F F U")},
              {"COUNT", counted, replaced(counted, "1 1 1 1 2", "1 2 1 1 1")},
              change("WIDTH", "WIDTH 2\nHEIGHT 1", "WIDTH 1\nHEIGHT 2"),
              change("HEIGHT", "HEIGHT 1", "HEIGHT 0"),
              change("VIEWPOINT", "0 0 0 1", "0 0 2 1"),
              {"POINTS", pcd,
               replaced(replaced(replaced(pcd, "POINTS 2", "POINTS 1"), "WIDTH 2", "WIDTH 1"),
                        "4 5 6 8\n", "")},
              {"DATA", header + "ascii\n" + twelve, header + "binary\n" + twelve}},
             pointsOf(".pcd"));
}

TEST(PointFilesKeys, Ply) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nelement camera 1\nproperty float view_px\n"
      "property float view_py\nproperty float view_pz\nproperty float focal\nend_header\n"
      "1 2 3 7\n4 5 6 8\n0 0 0 35\n";
  // Bytes that are one point in either order.
  const std::string bytes =
      " 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "abcdefghijk\n";
  const auto change = [&](const std::string& key, const std::string& from, const std::string& to) {
    return KeyCase{key, ply, replaced(ply, from, to)};
  };
  walkFormat(
      "Points: PLY",
      {{"format", "ply\nformat binary_little_endian" + bytes,
        "ply\nformat binary_big_endian" + bytes},
       change("comment", "element vertex", "comment viewpoint 1 2 3\nelement vertex"),
       change("obj_info", "element vertex", "obj_info scale 1000\nelement vertex"),
       {"element vertex", ply, replaced(replaced(ply, "vertex 2", "vertex 1"), "4 5 6 8\n", "")},
       change("element vertex/x", "1 2 3", "9 2 3"),
       change("element vertex/other", "1 2 3 7", "1 2 3 -1.#IND"),
       change("element camera/view_px", "0 0 0 35", "1 0 0 35"),
       change("element camera/view_px", "0 0 0 35", "0 1 0 35"),
       change("element camera/view_px", "0 0 0 35", "0 0 1 35"),
       change("element camera/other", "0 0 0 35", "0 0 0 nan"),
       {"element other", ply,
        replaced(ply, "end_header", "element camera2 1\nproperty int view_px\nend_header") +
            "9\n"}},
      pointsOf(".ply"));
}

TEST(PointFilesKeys, Xyz) {
  const std::string xyz = "1 2 3\n4 5 6\n";
  walkFormat("Points: XYZ",
             {{"x, y, z", xyz, "1 2 9\n4 5 6\n"},
              {"separator", xyz, "1, 2,3\n4;5;6\n"},
              {"further columns", xyz, "1 2 3 nan red\n4 5 6 7 8\n"},
              {"#", xyz, "# 7 8 9\n1 2 3\n4 5 6\n#\n"}},
             pointsOf(".xyz"));
}

/// A node of `.ot`: log odds, a colour perhaps, and a bit for each child.
std::string node(float logOdds, unsigned children, const std::string& colour = "") {
  std::string bytes;
  test::appendBinary(bytes, static_cast<double>(logOdds), {"", 'F', 4}, false);
  return bytes + colour + static_cast<char>(children);
}

std::string tree(const std::string& nodes, int count, const std::string& id = "OcTree",
                 const std::string& resolution = "0.5") {
  return "# Octomap OcTree file\nid " + id + "\nsize " + std::to_string(count) + "\nres " +
         resolution + "\ndata\n" + nodes;
}

TEST(PointFilesKeys, Octomap) {
  const Answer answer = [](const std::string& text) {
    const test::TemporaryFolder folder;
    const bool isBinary = text.starts_with("# Octomap OcTree binary");
    const OccupancyMap map = loadOctomap(folder.write(isBinary ? "a.bt" : "a.ot", text));
    std::ostringstream said;
    said << map.resolution;
    for (const OccupancyMap::Cube& cube : map.occupied)
      said << '\n' << cube.center.transpose() << ' ' << cube.side;
    return said.str();
  };
  const std::string one = tree(node(1, 0), 1), colour = "abc";
  const std::string inner = tree(node(1, 4) + node(1, 0), 2);
  const std::string root = "# Octomap OcTree binary file\nid OcTree\nres 0.5\nsize ";
  walkFormat("OctoMap (.bt, .ot)",
             {{"#", one, replaced(one, "id", "# occupancy threshold 0.9\nid")},
              // Of the same bytes: two nodes of 5, or one of 8 and what is no node.
              {"id", one, tree(node(-1, 0, colour), 1, "ColorOcTree")},
              {"res", one, tree(node(1, 0), 1, "OcTree", "0.25")},
              {"size", tree("", 0), one},
              {"data", tree("", 0), one},
              {"log odds", one, tree(node(-0.5F, 0), 1)},
              {"log odds", tree(node(0, 0), 1), tree(node(-1e-30F, 0), 1)},
              {"log odds of an inner node", inner, tree(node(-1, 4) + node(1, 0), 2)},
              {"colour", tree(node(1, 0, "abc"), 1, "ColorOcTree"),
               tree(node(1, 0, "xyz"), 1, "ColorOcTree")},
              {"child bits", inner, tree(node(1, 8) + node(1, 0), 2)},
              {"child bits", root + "2\ndata\n" + std::string("\x02\0", 2),
               root + "2\ndata\n" + std::string("\x01\0", 2)}},
             answer);
}

}  // namespace
}  // namespace swept
