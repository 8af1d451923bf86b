// SPDX-License-Identifier: BSD-3-Clause
//
// Good files of sensed points, written by cloud_writers.hpp, give the points back exactly.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "cloud_writers.hpp"
#include "input_files.hpp"
#include "io/lzf.hpp"
#include "swept/robot_model/cloud_file.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using test::CloudField;
using test::kDoubles;
using test::kFloats;
using test::Points;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

/// Of single precision, so that every type of file can hold them, from 1e-6 to 1e6 m.
Points randomPoints(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-6.0, 6.0);
  std::uniform_real_distribution<double> sign(-1.0, 1.0);
  Points points(count);
  for (Vector3d& point : points) {
    for (double& value : point) {
      value = static_cast<float>(std::copysign(std::pow(10.0, exponent(random)), sign(random)));
    }
  }
  return points;
}

const Points kThree{{1.5, -2.25, 3.0}, {4.0, 5.0, -6.5}, {0.0, 0.125, 1e6}};

class CloudFiles : public ::testing::Test {
 protected:
  Points load(const std::string& name, const std::string& text) {
    warnings_.lines.clear();
    return loadPoints(folder_.write(name, text), warnings_.options());
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  const test::TemporaryFolder folder_;
  test::Warnings warnings_;
};

/// Exact, and in order.
void expectSame(const Points& loaded, const Points& written, const std::string& what) {
  ASSERT_EQ(loaded.size(), written.size()) << what;
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    ASSERT_EQ(loaded[i], written[i]) << what << ", point " << i;
  }
}

TEST_F(CloudFiles, HundredThousandPointsComeBackExactlyFromPcd) {
  const Points points = randomPoints(100'000, 1);
  Points fine = points;
  for (Vector3d& point : fine) point *= 1.0 / 3.0;
  for (const std::string form : {"ascii", "binary", "binary_compressed"}) {
    expectSame(load("a.pcd", test::pcd(points, kFloats, form)), points, form + " F4");
    expectSame(load("a.pcd", test::pcd(fine, kDoubles, form)), fine, form + " F8");
    EXPECT_THAT(warnings_.lines, IsEmpty());
  }
}

TEST_F(CloudFiles, HundredThousandPointsComeBackExactlyFromPlyAndXyz) {
  const Points points = randomPoints(100'000, 2);
  for (const std::string form : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const bool big = form == "binary_big_endian";
    const auto file = test::ply({test::plyVertex(points, kFloats, big)}, form);
    expectSame(load("a.ply", file), points, form);
  }
  Points fine = points;
  for (Vector3d& point : fine) point *= 1.0 / 3.0;
  expectSame(load("a.xyz", test::xyz(fine)), fine, "xyz");
}

TEST_F(CloudFiles, PcdFieldsComeInAnyOrderNumberAndType) {
  const std::vector<CloudField> first{{"rgb", 'U', 4},   {"z", 'F', 8},    {"_", 'U', 1, 3},
                                      {"x", 'F', 4},     {"n", 'F', 4, 3}, {"_", 'I', 2},
                                      {"ring", 'U', 2},  {"y", 'F', 8},    {"time", 'F', 8},
                                      {"stamp", 'I', 8}, {"x_origin"}};
  for (const std::string form : {"ascii", "binary", "binary_compressed"}) {
    expectSame(load("a.pcd", test::pcd(kThree, first, form)), kThree, form);
  }
}

TEST_F(CloudFiles, CoordinatesMayBeWholeNumbers) {
  for (const char type : {'I', 'U'}) {
    const double sign = type == 'I' ? -1.0 : 1.0;
    const Points points{{3.0, 200.0 / 2.0, sign * 7.0}, {sign * 127.0, 0.0, 1.0}};
    for (const int size : {1, 2, 4, 8}) {
      const std::vector<CloudField> fields{
          {"y", type, size}, {"i"}, {"x", type, size}, {"z", type, size}};
      const std::string what = type + std::to_string(size);
      for (const std::string form : {"ascii", "binary", "binary_compressed"}) {
        expectSame(load("a.pcd", test::pcd(points, fields, form)), points, what + form);
      }
      if (size == 8) continue;
      for (const std::string form : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const bool big = form == "binary_big_endian";
        const auto file = test::ply({test::plyVertex(points, fields, big)}, form);
        expectSame(load("a.ply", file), points, what + form);
      }
    }
  }
}

TEST_F(CloudFiles, PlyElementsAndListsAroundTheVertexAreSkipped) {
  const std::vector<CloudField> fields{{"nx"},        {"z", 'F', 8},  {"red", 'U', 1},
                                       {"x", 'F', 4}, {"id", 'I', 4}, {"y", 'F', 8}};
  for (const std::string form : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const bool big = form == "binary_big_endian";
    const test::PlyPart vertex = test::plyVertex(kThree, fields, big);
    const test::PlyPart before = test::plyFaces("strip", 5, big);
    const test::PlyPart after = test::plyFaces("face", 7, big);
    const test::PlyPart none{"element nothing 4\n", "", ""};
    const test::PlyPart camera = test::plyVertex({{7.0, 8.0, 9.0}}, kFloats, big);
    test::PlyPart other = camera;
    other.header.replace(0, other.header.find('\n'), "element camera 1");
    expectSame(load("a.ply", test::ply({before, other, vertex, none, after}, form)), kThree, form);
    expectSame(load("a.ply", test::ply({vertex}, form)), kThree, form);
  }
}

TEST_F(CloudFiles, PlyVerticesMayHaveListsThemselves) {
  const test::PlyPart vertex{
      "element vertex 2\nproperty list uint8 float32 weights\nproperty float32 x\n"
      "property float32 y\nproperty list int16 uint16 bones\nproperty float32 z\n",
      "2 0.5 0.25 1 2 1 4 3\n0 -1 -2 3 1 2 3 -3\n", ""};
  const Points expected{{1.0, 2.0, 3.0}, {-1.0, -2.0, -3.0}};
  expectSame(load("a.ply", test::ply({vertex}, "ascii")), expected, "ascii");
  for (const bool big : {false, true}) {
    test::PlyPart binary = vertex;
    const auto add = [&](std::initializer_list<double> values, char type, int size) {
      for (const double value : values) {
        test::appendBinary(binary.binary, value, {"", type, size}, big);
      }
    };
    add({2}, 'U', 1);
    add({0.5, 0.25, 1.0, 2.0}, 'F', 4);
    add({1, 4}, 'I', 2);
    add({3.0}, 'F', 4);
    add({0}, 'U', 1);
    add({-1.0, -2.0}, 'F', 4);
    add({3, 1, 2, 3}, 'I', 2);
    add({-3.0}, 'F', 4);
    const std::string form = big ? "binary_big_endian" : "binary_little_endian";
    expectSame(load("a.ply", test::ply({binary}, form)), expected, form);
  }
}

TEST_F(CloudFiles, LinesMayEndAsInDos) {
  expectSame(load("a.pcd", test::pcd(kThree, kDoubles, "ascii", "\r\n")), kThree, "pcd");
  expectSame(load("a.pcd", test::pcd(kThree, kDoubles, "binary", "\r\n")), kThree, "pcd");
  for (const std::string form : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const bool big = form == "binary_big_endian";
    const test::PlyPart vertex = test::plyVertex(kThree, kDoubles, big, "\r\n");
    const test::PlyPart faces = test::plyFaces("face", 2, big, "\r\n");
    expectSame(load("a.ply", test::ply({vertex, faces}, form, "\r\n")), kThree, form);
  }
  expectSame(load("a.xyz", "# one\r\n\r\n1 2 3\r\n4\t5\t6"), {{1, 2, 3}, {4, 5, 6}}, "xyz");
}

TEST_F(CloudFiles, AMarkOfUtf8IsPassedOver) {
  const std::string mark = "\xef\xbb\xbf";
  expectSame(load("a.xyz", mark + test::xyz(kThree)), kThree, "xyz");
  for (const std::string form : {"ascii", "binary"})
    expectSame(load("a.pcd", mark + test::pcd(kThree, kDoubles, form, "\n")), kThree, form);
  for (const std::string form : {"ascii", "binary_little_endian"})
    expectSame(
        load("a.ply", mark + test::ply({test::plyVertex(kThree, kDoubles, false, "\n")}, form)),
        kThree, form);
}

TEST_F(CloudFiles, XyzLinesHaveOneKindOfSeparator) {
  const Points points{{1.5, -2.0, 3e2}};
  for (const std::string line :
       {"1.5 -2 3e2", "\t1.5\t-2.0  300 ", "1.5,-2,300", "1.5;-2;3E+2", " 1.5 , -2 ,\t300.0 , 7",
        "+1.5 -2 +300 255 0 0 car", "1.5,-2,300,a;b c", "1.5; -2; 300 255", "01.5 -2. 3.e2"}) {
    expectSame(load("a.xyz", line), points, line);
    expectSame(load("a.xyz", "\n  # x y z\n" + line + "\n\n#"), points, line);
  }
}

TEST_F(CloudFiles, PointsThatAreNotFiniteAreLeftOutWithOneRemark) {
  const Points points{{kNan, kNan, kNan}, {1, 2, 3},         {4, 5, kInfinity},
                      {-kInfinity, 1, 2}, {1.0, -kNan, 0.0}, {7, 8, 9}};
  const Points finite{{1, 2, 3}, {7, 8, 9}};
  const auto expectRemark = [&](const std::string& name, const std::string& text) {
    expectSame(load(name, text), finite, name);
    EXPECT_THAT(warnings_.lines,
                ElementsAre(path(name) + ": warning: 4 of 6 points are not finite and left out"));
  };
  for (const std::string form : {"ascii", "binary", "binary_compressed"}) {
    expectRemark("a.pcd", test::pcd(points, kFloats, form));
  }
  for (const std::string form : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const bool big = form == "binary_big_endian";
    expectRemark("a.ply", test::ply({test::plyVertex(points, kDoubles, big)}, form));
  }
  expectRemark("a.xyz", test::xyz(points));
  expectRemark("a.xyz", "NaN NAN nan\n1 2 3\n4 5 Inf\n-infinity 1 2\n1 -nan 0\n7 8 9\n");
  expectRemark(
      "a.xyz",
      "-1.#IND 1.#QNAN 1.#QNAN0\n1 2 3\n4 5 1.#INF00\n-1.#INF 1 2\n1 -nan(ind) 0\n7 8 9\n");
  // Nobody has to listen.
  EXPECT_EQ(loadPoints(folder_.write("a.xyz", test::xyz(points))).size(), 2u);
}

TEST_F(CloudFiles, PcdHeadersMayBeShortOrCommented) {
  for (const std::string version : {"0.6", ".6", "0.7", ".7"}) {
    expectSame(load("a.pcd", "VERSION " + version +
                                 "\n\n# made by hand\nFIELDS\tx y  z \nSIZE 4 4 4\nTYPE F F F\n"
                                 "WIDTH 1\nHEIGHT 2\nPOINTS 2\nDATA ascii\n\n1 2 3\n \n4 5 6\n\n"),
               {{1, 2, 3}, {4, 5, 6}}, version);
  }
}

/// What the Point Cloud Library writes and reads of older and shorter headers.
TEST_F(CloudFiles, PcdHeadersMayBeOld) {
  const Points two{{1, 2, 3}, {4, 5, 6}};
  const std::string data = "DATA ascii\n1 2 3\n4 5 6\n";
  const std::string typed = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  for (const std::string header :
       {"COLUMNS x y z\nPOINTS 2\n", "VERSION .5\nCOLUMNS x y z\nPOINTS 2\n",
        "VERSION 0.5\nFIELDS x y z\nWIDTH 0\nHEIGHT 0\nPOINTS 2\n"})
    expectSame(load("a.pcd", header + data), two, header);
  for (const std::string size : {"", "WIDTH 2\n", "WIDTH 2\nHEIGHT 0\n", "WIDTH 1\nHEIGHT 2\n"})
    expectSame(load("a.pcd", typed + size + "POINTS 2\n" + data), two, size);
  const std::string small = "SIZE 4 4 4 1\nTYPE f f F b\nPOINTS 1\nDATA ascii\n1 2 3 1\n";
  expectSame(load("a.pcd", "FIELDS x y z seen\n" + small), {{1, 2, 3}}, "types");
}

/// Drivers of lidars write them for padding.
TEST_F(CloudFiles, PcdFieldsOfNoValuesAreNotThere) {
  const std::vector<CloudField> fields{{"_", 'U', 1, 0}, {"x"}, {"_", 'U', 2, 0}, {"y"}, {"z"},
                                       {"_", 'F', 8, 0}};
  for (const std::string form : {"ascii", "binary", "binary_compressed"})
    expectSame(load("a.pcd", test::pcd(kThree, fields, form)), kThree, form);
}

class SensedFiles : public CloudFiles {
 protected:
  Vector3d sensorOf(const std::string& name, const std::string& text) {
    warnings_.lines.clear();
    const auto sensed = loadSensedPoints(folder_.write(name, text), warnings_.options());
    expectSame(sensed.points, kThree, name);
    return sensed.sensor;
  }
  void expectRemark(const std::string& what) const {
    EXPECT_THAT(
        warnings_.lines,
        ElementsAre(testing::EndsWith(
            ": warning: " + what +
            " is where the sensor was, in the frame of the points; it does not move them")));
  }
};

TEST_F(SensedFiles, AViewpointIsTheSensor) {
  const std::string still = "VIEWPOINT 0 0 0 1 0 0 0";
  for (const std::string form : {"ascii", "binary", "binary_compressed"}) {
    const std::string text = test::pcd(kThree, kFloats, form);
    EXPECT_EQ(sensorOf("a.pcd", text), Vector3d(0, 0, 0));
    EXPECT_THAT(warnings_.lines, IsEmpty());
    const auto with = [&](const std::string& viewpoint) {
      std::string other = text;
      return other.replace(other.find(still), still.size(), viewpoint);
    };
    EXPECT_EQ(sensorOf("a.pcd", with("VIEWPOINT -1 0.25 1.5 1 0 0 0")), Vector3d(-1, 0.25, 1.5));
    expectRemark("VIEWPOINT");
    EXPECT_EQ(sensorOf("a.pcd", with("VIEWPOINT 0 0 0 0 1 0 0")), Vector3d(0, 0, 0));
    expectRemark("VIEWPOINT");
    // Which way it looked is nothing to what its rays pass.
    EXPECT_EQ(sensorOf("a.pcd", with("VIEWPOINT 1 2 3 0 0 0 0")), Vector3d(1, 2, 3));
    EXPECT_EQ(sensorOf("a.pcd", with("#")), Vector3d(0, 0, 0));
    EXPECT_THAT(warnings_.lines, IsEmpty());
  }
}

TEST_F(SensedFiles, ACameraOfAPlyIsTheSensor) {
  for (const std::string form : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const bool big = form == "binary_big_endian";
    const test::PlyPart vertex = test::plyVertex(kThree, kFloats, big);
    const auto with = [&](const Vector3d& at, const std::vector<CloudField>& fields) {
      test::PlyPart camera = test::plyVertex({at}, fields, big);
      camera.header.replace(0, camera.header.find('\n'), "element camera 1");
      for (const std::string axis : {"x", "y", "z"}) {
        const auto place = camera.header.find(" " + axis + "\n");
        camera.header.replace(place, 2, " view_p" + axis);
      }
      return camera;
    };
    const std::vector<CloudField> fields{{"x_axisx"}, {"z", 'F', 8}, {"x"}, {"y"}, {"focal"}};
    const test::PlyPart camera = with({-1, 0.25, 1.5}, fields);
    EXPECT_EQ(sensorOf("a.ply", test::ply({vertex, camera}, form)), Vector3d(-1, 0.25, 1.5));
    expectRemark("the camera");
    EXPECT_EQ(sensorOf("a.ply", test::ply({camera, vertex}, form)), Vector3d(-1, 0.25, 1.5));
    EXPECT_EQ(sensorOf("a.ply", test::ply({vertex, with({0, 0, 0}, fields)}, form)),
              Vector3d(0, 0, 0));
    EXPECT_THAT(warnings_.lines, IsEmpty());
    EXPECT_EQ(sensorOf("a.ply", test::ply({vertex}, form)), Vector3d(0, 0, 0));
  }
  EXPECT_EQ(sensorOf("a.xyz", test::xyz(kThree)), Vector3d(0, 0, 0));
}

TEST_F(CloudFiles, ZerosBehindABinaryPcdArePadding) {
  for (const std::string form : {"binary", "binary_compressed"}) {
    const std::string text = test::pcd(kThree, kFloats, form) + std::string(4096, '\0');
    expectSame(load("a.pcd", text), kThree, form);
  }
}

TEST_F(CloudFiles, EndingsMayBeInCapitals) {
  expectSame(load("A.PCD", test::pcd(kThree, kFloats, "binary")), kThree, "pcd");
  expectSame(load("A.Ply", test::ply({test::plyVertex(kThree, kFloats, false)}, "ascii")), kThree,
             "ply");
  expectSame(load("A.XYZ", test::xyz(kThree)), kThree, "xyz");
}

std::string expanded(const std::string& data, std::size_t size) {
  std::string output(size, '?');
  const auto fault = detail::expandLzf(data, output);
  return fault ? "at " + std::to_string(fault->at) + ": " + fault->what : output;
}

TEST(Lzf, ExpandsWhatTheFormatSays) {
  using namespace std::string_literals;
  EXPECT_EQ(expanded("\x02"s + "abc", 3), "abc");
  // 3 bits of length less 2, 13 bits of distance less 1.
  EXPECT_EQ(expanded("\x02"s + "abc" + "\x20\x02"s, 6), "abcabc");
  EXPECT_EQ(expanded("\x02"s + "abc" + "\x40\x00"s, 7), "abccccc");
  // Length 7 + 5 + 2 of what overlaps itself.
  EXPECT_EQ(expanded("\x02"s + "abc" + "\xe0\x05\x02"s, 17), "abcabcabcabcabcab");
  // A distance of 0x1f00 + 1 needs the low bits of the first byte.
  std::string far;
  for (int i = 0; i < 249; ++i) far += "\x1f"s + std::string(32, static_cast<char>('a' + i % 9));
  const std::string plain = expanded(far, far.size() / 33 * 32);
  EXPECT_EQ(expanded(far + "\xff\xff\x00"s, plain.size() + 264),
            plain + plain.substr(plain.size() - 0x1f01, 264));
}

TEST(Lzf, UndoesTheEncoder) {
  std::mt19937 random(7);
  std::size_t shrunk = 0;
  constexpr int kRounds = 300;
  for (int round = 0; round < kRounds; ++round) {
    std::uniform_int_distribution<int> length(1, 30'000);
    std::uniform_int_distribution<int> letter(0, round % 6 == 0 ? 0 : round % 6 * 50);
    std::string data(static_cast<std::size_t>(length(random)), ' ');
    for (std::size_t i = 0; i < data.size(); ++i) {
      const bool again = round % 2 == 0 && i >= 5000 && i % 700 > 30;
      data[i] = again ? data[i - 5000] : static_cast<char>(letter(random));
    }
    const std::string packed = test::lzf(data);
    shrunk += packed.size() < data.size() / 2 ? 1 : 0;
    ASSERT_LE(data.size(), packed.size() * detail::kLzfRatio) << round;
    ASSERT_EQ(expanded(packed, data.size()), data) << round;
  }
  EXPECT_GT(shrunk, kRounds * 3 / 10);
  EXPECT_LT(shrunk, kRounds * 9 / 10);
}

}  // namespace
}  // namespace swept
