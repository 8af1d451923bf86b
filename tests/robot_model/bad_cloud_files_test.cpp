// SPDX-License-Identifier: BSD-3-Clause
//
// Broken files of points and maps, and the exact messages they give.
#include <gtest/gtest.h>

#include "bad_cloud_files.hpp"
#include "cloud_writers.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using test::at;
using test::BadFile;
using test::load;
using test::replaced;
using test::times;

const test::Points kTwo{{1, 2, 3}, {4, 5, 6}};

/// In text, of two points, with one part replaced. FIELDS is line 3, DATA line 11.
std::string pcd(const std::string& from, const std::string& to, const std::string& form = "ascii") {
  return replaced(test::pcd(kTwo, test::kFloats, form), from, to);
}

/// Of two points of 12 bytes with other data; the header has `at` bytes.
const std::string kBinary = test::pcdHeader(2, test::kFloats, "binary");
const std::string kCompressed = test::pcdHeader(2, test::kFloats, "binary_compressed");

/// The sizes of compressed data, little endian.
std::string sizes(unsigned compressed, unsigned expanded) {
  std::string out;
  test::appendBinary(out, compressed, {"", 'U', 4}, false);
  test::appendBinary(out, expanded, {"", 'U', 4}, false);
  return out;
}

std::string compressed(const std::string& data) {
  return kCompressed + sizes(static_cast<unsigned>(data.size()), 24) + data;
}

std::vector<BadFile> pcdHeaders() {
  const std::string three = " values; it must have 3";
  return {
      {"Empty", "a.pcd", "", ": error: the file is empty"},
      {"NoPcd", "a.pcd",
       "\x7f"
       "ELF\x02\n",
       ":1: error: unknown entry '?ELF?' of a PCD header; allowed are VERSION, FIELDS, SIZE, TYPE, "
       "COUNT, WIDTH, HEIGHT, VIEWPOINT, POINTS and DATA"},
      {"NoData", "a.pcd", "VERSION .7\nFIELDS x y z\n",
       ": error: the file ends where an entry DATA of its header should follow"},
      {"OtherVersion", "a.pcd", pcd("0.7\n", "0.8\n"),
       ":2: error: VERSION is '0.8'; allowed are 0.5, 0.6 and 0.7"},
      {"FieldsTwice", "a.pcd", pcd("SIZE", "COLUMNS x y z\nSIZE"),
       ":4: error: a second entry FIELDS; the first is at line 3"},
      {"NoFields", "a.pcd", pcd("FIELDS x y z\n", ""),
       ":10: error: the header has no entry FIELDS"},
      {"NoSize", "a.pcd", pcd("SIZE 4 4 4\n", ""), ":10: error: the header has no entry SIZE"},
      {"NoType", "a.pcd", pcd("TYPE F F F\n", ""), ":10: error: the header has no entry TYPE"},
      {"NoWidth", "a.pcd", pcd("WIDTH 2\n", ""), ":10: error: the header has no entry WIDTH"},
      {"OtherHeight", "a.pcd", replaced(pcd("HEIGHT 1\n", ""), "WIDTH 2", "WIDTH 1"),
       ":9: error: POINTS is 2, but WIDTH times HEIGHT 1"},
      {"NoPoints", "a.pcd", pcd("POINTS 2\n", ""), ":10: error: the header has no entry POINTS"},
      {"Twice", "a.pcd", pcd("SIZE", "FIELDS x\nSIZE"),
       ":4: error: a second entry FIELDS; the first is at line 3"},
      {"FewSizes", "a.pcd", pcd("SIZE 4 4 4", "SIZE 4 4"), ":4: error: SIZE has 2" + three},
      {"ManyTypes", "a.pcd", pcd("TYPE F", "TYPE F F"), ":5: error: TYPE has 4" + three},
      {"FewCounts", "a.pcd", pcd("COUNT 1 1 1", "COUNT"), ":6: error: COUNT has 0" + three},
      {"TwoWidths", "a.pcd", pcd("WIDTH 2", "WIDTH 2 2"),
       ":7: error: WIDTH has 2 values; it must have 1"},
      {"NoZ", "a.pcd", pcd("x y z", "x y Z"),
       ":3: error: FIELDS does not name 'z'; x, y and z are needed"},
      {"TwoX", "a.pcd", pcd("x y z", "x y x"), ":3: error: FIELDS names 'x' twice"},
      {"OddSize", "a.pcd", pcd("SIZE 4 4", "SIZE 4 3"),
       ":4: error: SIZE of 'y' is '3'; allowed are 1, 2, 4 and 8"},
      {"UnknownType", "a.pcd", pcd("TYPE F F", "TYPE F D"),
       ":5: error: TYPE of 'y' is 'D'; allowed are F, I and U"},
      {"ShortFloat", "a.pcd", pcd("SIZE 4 4 4", "SIZE 4 4 2"),
       ":4: error: SIZE of 'z' is '2'; of TYPE F, 4 and 8 are allowed"},
      {"NoY", "a.pcd", pcd("COUNT 1 1 1", "COUNT 1 0 1"),
       ":6: error: COUNT of 'y' is '0'; it must be 1"},
      {"NegativeCount", "a.pcd", pcd("COUNT 1 1 1", "COUNT 1 -1 1"),
       ":6: error: COUNT is '-1'; it must be a whole number from 0 to 1048576"},
      {"ManyX", "a.pcd", pcd("COUNT 1", "COUNT 2"), ":6: error: COUNT of 'x' is '2'; it must be 1"},
      {"WidthNoNumber", "a.pcd", pcd("WIDTH 2", "WIDTH 2.0"),
       ":7: error: WIDTH is '2.0'; it must be a whole number from 0 to 50000000"},
      {"NegativeHeight", "a.pcd", pcd("HEIGHT 1", "HEIGHT -1"),
       ":8: error: HEIGHT is '-1'; it must be a whole number from 0 to 50000000"},
      {"Shape", "a.pcd", pcd("HEIGHT 1", "HEIGHT 3"),
       ":10: error: POINTS is 2, but WIDTH times HEIGHT 6"},
      {"ZeroPoints", "a.pcd", replaced(pcd("WIDTH 2", "WIDTH 0"), "POINTS 2", "POINTS 0"),
       ":10: error: POINTS is '0'; it must be a whole number from 1 to 50000000"},
      {"TooManyPoints", "a.pcd", pcd("POINTS 2", "POINTS 50000001"),
       ":10: error: POINTS is '50000001'; it must be a whole number from 1 to 50000000"},
      {"Viewpoint", "a.pcd", pcd("0 0 0 1 0 0 0", "0 0 0 1"),
       ":9: error: VIEWPOINT has 4 values; it must have 7"},
      {"ViewpointNoNumber", "a.pcd", pcd("0 0 0 1 0 0 0", "0 0 nan 1 0 0 0"),
       ":9: error: VIEWPOINT has 'nan'; it must be 7 finite numbers: x, y, z, then a quaternion w, "
       "x, y, z"},
      {"UnknownForm", "a.pcd", pcd("DATA ascii", "DATA text"),
       ":11: error: DATA is 'text'; allowed are ascii, binary and binary_compressed"},
      {"HugePoint", "a.pcd",
       pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1",
           "FIELDS x y z" + times(300, " a") + "\nSIZE 4 4 4" + times(300, " 8") + "\nTYPE F F F" +
               times(300, " F") + "\nCOUNT 1 1 1" + times(300, " 1048576")),
       ":3: error: a point has 2516582412 bytes; at most 2147483647 are allowed"},
  };
}

std::vector<BadFile> pcdData() {
  const std::string run = "\x17"s + std::string(24, 'a');
  return {
      {"NoMicrosoftNumber", "a.pcd", pcd("4 5 6", "4 5 -1.#1ND"),
       ":13: error: z is '-1.#1ND'; it must be a number that a double can hold"},
      {"NoNumber", "a.pcd", pcd("4 5 6", "4 5 6m"),
       ":13: error: z is '6m'; it must be a number that a double can hold"},
      {"HugeNumber", "a.pcd", pcd("4 5 6", "4 1e999 6"),
       ":13: error: y is '1e999'; it must be a number that a double can hold"},
      {"FewValues", "a.pcd", pcd("1 2 3", "1 2 "),
       ":12: error: the line ends where 'z' should follow"},
      {"ManyValues", "a.pcd", pcd("1 2 3", "1 2 3 4"),
       ":12: error: '4' follows the last value of the line"},
      {"FewLines", "a.pcd", pcd("4 5 6\n", "\n"), ":13: error: the file ends after 1 of 2 points"},
      {"ManyLines", "a.pcd", pcd("4 5 6\n", "4 5 6\n\n7 8 9\n"),
       ":15: error: more follows after the last of 2 points"},
      {"NothingFinite", "a.pcd", pcd("1 2 3\n4 5 6", "nan 2 3\n4 5 inf"),
       ": error: none of its 2 points is finite"},
      {"ShortBinary", "a.pcd", kBinary + std::string(23, 'a'),
       at(kBinary, 0, "23 bytes of data follow; 2 points of 12 bytes have 24")},
      {"LongBinary", "a.pcd", kBinary + std::string(24, 'a') + "\0\0b"s,
       at(kBinary, 26, "more follows after the last point")},
      {"NoSizes", "a.pcd", kCompressed + "\1\0\0\0\1\0\0"s,
       at(kCompressed, 0, "the file ends within the sizes of the compressed data")},
      {"ShortCompressed", "a.pcd", kCompressed + sizes(30, 24) + run,
       at(kCompressed, 0, "the compressed data have 30 bytes, but 25 follow")},
      {"OtherSize", "a.pcd", kCompressed + sizes(25, 36) + run,
       at(kCompressed, 4, "the data expand to 36 bytes, but the points have 24")},
      {"LongCompressed", "a.pcd", compressed(run) + "b",
       at(kCompressed, 8 + 25, "more follows after the last point")},
      {"LzfRunTooLong", "a.pcd", compressed("\x17"s + std::string(23, 'a')),
       at(kCompressed, 8, "broken LZF data: a run goes beyond their end")},
      {"LzfEndsInRepetition", "a.pcd", compressed(run + "\x20"),
       at(kCompressed, 8 + 25, "broken LZF data: they end within a repetition")},
      {"LzfEndsInLongRepetition", "a.pcd", compressed(run + "\xe0\x05"),
       at(kCompressed, 8 + 25, "broken LZF data: they end within a repetition")},
      {"LzfBeforeTheBeginning", "a.pcd", compressed("\0a\x20\1"s),
       at(kCompressed, 8 + 2, "broken LZF data: a repetition goes back beyond their beginning")},
      {"LzfTooMuch", "a.pcd", compressed(run + "\0b"s),
       at(kCompressed, 8 + 25, "broken LZF data: they expand to more than 24 bytes")},
      {"LzfRepetitionTooMuch", "a.pcd", compressed("\0a\xe0\x10\0"s),
       at(kCompressed, 8 + 2, "broken LZF data: they expand to more than 24 bytes")},
      {"LzfTooLittle", "a.pcd", compressed("\0a\xe0\x0d\0"s),
       at(kCompressed, 8 + 5, "broken LZF data: they expand to 23 bytes instead of 24")},
  };
}

/// So many points of so many bytes, compressed to 8.
BadFile bomb(const std::string& name, unsigned points, unsigned extra, std::size_t offset,
             const std::string& message) {
  std::vector<test::CloudField> fields = test::kFloats;
  fields.push_back({"rest", 'U', 4, static_cast<int>(extra)});
  const std::string header = test::pcdHeader(points, fields, "binary_compressed");
  const std::string text = header + sizes(8, points * 4 * (3 + extra)) + "abcdefgh";
  return {name, "a.pcd", text, at(header, offset, message)};
}

std::vector<BadFile> bombs() {
  return {
      bomb("Bomb", 50'000'000, 1, 0, "8 bytes cannot expand to 800000000"),
      bomb("LargeBomb", 50'000'000, 9, 4,
           "the data expand to 2400000000 bytes; at most 2147483647 are allowed"),
  };
}

/// The word `vertex` is in line 5; its values are in lines 10 and 11.
std::string ply(const std::string& from, const std::string& to) {
  return replaced(test::ply({test::plyVertex(kTwo, test::kFloats, false)}, "ascii"), from, to);
}

std::vector<BadFile> plyHeaders() {
  const std::string types =
      " is not known; allowed are char, uchar, short, ushort, int, uint, float, double, int8, "
      "uint8, int16, uint16, int32, uint32, float32 and float64";
  return {
      {"NoPly", "a.ply", "plyx\n", ":1: error: the first line is 'plyx'; it must be 'ply'"},
      {"LongFirstLine", "a.ply", times(50, "a"),
       ":1: error: the first line is '" + times(40, "a") + "...'; it must be 'ply'"},
      {"NoFormat", "a.ply", ply("format ascii 1.0\n", ""),
       ":8: error: the header has no line 'format'"},
      {"TwoFormats", "a.ply", ply("format", "format ascii 1.0\nformat"),
       ":3: error: a second line 'format'; one is allowed"},
      {"ShortFormat", "a.ply", ply("ascii 1.0", "ascii"),
       ":2: error: 'format' must have a form and a version behind it"},
      {"UnknownFormat", "a.ply", ply("ascii", "binary"),
       ":2: error: the format is 'binary'; allowed are ascii, binary_little_endian and "
       "binary_big_endian"},
      {"OtherVersion", "a.ply", ply("1.0", "2.0"),
       ":2: error: the version of the format is '2.0'; it must be 1.0"},
      {"ShortElement", "a.ply", ply("vertex 2", "vertex"),
       ":5: error: 'element' must have a name and a count behind it"},
      {"NegativeCount", "a.ply", ply("vertex 2", "vertex -2"),
       ":5: error: the count of element 'vertex' is '-2'; it must be a whole number from 0 to "
       "9e15"},
      {"TwoVertices", "a.ply", ply("end_header", "element vertex 1\nend_header"),
       ":9: error: a second element 'vertex'; the first is at line 5"},
      {"TooManyVertices", "a.ply", ply("vertex 2", "vertex 50000001"),
       ":5: error: the count of element 'vertex' is '50000001'; at most 50000000 are allowed"},
      {"NoVertex", "a.ply", ply("element vertex 2", "element point 2"),
       ":9: error: the header has no element 'vertex'"},
      {"EarlyProperty", "a.ply", ply("element vertex 2", "property int x\nelement vertex 2"),
       ":5: error: 'property' before the first 'element'"},
      {"ShortProperty", "a.ply", ply("float y", "float"),
       ":7: error: 'property' must have a type and a name behind it, or 'list', two types and a "
       "name"},
      {"ShortList", "a.ply", ply("float y", "list uchar y"),
       ":7: error: 'property' must have a type and a name behind it, or 'list', two types and a "
       "name"},
      {"UnknownType", "a.ply", ply("float y", "float16 y"),
       ":7: error: the type 'float16'" + types},
      {"UnknownListType", "a.ply", ply("float y", "list uchar real a"),
       ":7: error: the type 'real'" + types},
      {"FloatLength", "a.ply", ply("float y", "list float int a"),
       ":7: error: the length of list 'a' is of type 'float'; it must be of a type of whole "
       "numbers"},
      {"ListOfX", "a.ply", ply("float x", "list uchar float x"),
       ":6: error: 'x' of the vertex is a list; it must be a number"},
      {"TwoX", "a.ply", ply("float y", "float x"),
       ":7: error: a second property 'x' of the vertex"},
      {"NoZ", "a.ply", ply("float z", "float w"),
       ":5: error: the vertex has no property 'z'; x, y and z are needed"},
      {"HalfACamera", "a.ply",
       ply("end_header", "element camera 1\nproperty int view_px\nend_header"),
       ":9: error: the camera must have view_px, view_py and view_pz once each, or none of them"},
      {"TwoCameras", "a.ply",
       ply("end_header",
           "element camera 2\nproperty int view_px\nproperty int view_py\nproperty int view_pz\n"
           "end_header"),
       ":9: error: the count of element 'camera' is '2'; points that one sensor saw have one"},
      {"NoPlace", "a.ply",
       ply("end_header",
           "element camera 1\nproperty float view_px\nproperty float view_py\n"
           "property float view_pz\nend_header") +
           "0 nan 0\n",
       ":9: error: view_px, view_py and view_pz of the camera must be finite"},
      {"UnknownWord", "a.ply", ply("end_header", "end"),
       ":9: error: unknown word 'end' in a PLY header; allowed are format, comment, obj_info, "
       "element, property and end_header"},
      {"NoEnd", "a.ply", "ply\nformat ascii 1.0\n",
       ": error: the file ends where 'end_header' should follow"},
  };
}

std::vector<BadFile> plyData() {
  const std::string text = ply("", "");
  const std::string little = "binary_little_endian";
  const std::string list = "element face 2\nproperty list char int corners\n";
  const std::string header =
      test::ply({test::plyVertex({}, test::kFloats, false), {list, "", ""}}, little);
  const std::string faces = replaced(header, "vertex 0", "vertex 2") + std::string(24, 'a');
  const std::string face = "\2aaaabbbb";
  return {
      {"NoNumber", "a.ply", ply("1 2 3", "1 2 -"),
       ":10: error: z is '-'; it must be a number that a double can hold"},
      {"FewVertices", "a.ply", ply("4 5 6\n", ""),
       ":10: error: the file ends after 1 of 2 elements 'vertex'"},
      {"ManyVertices", "a.ply", text + "7 8 9",
       ":12: error: more follows after the last element "
       "of the header"},
      {"NoVertices", "a.ply", replaced(ply("1 2 3\n4 5 6\n", ""), "vertex 2", "vertex 0"),
       ": error: the file has no points"},
      {"ListTooLong", "a.ply",
       replaced(ply("float x", "list uchar int a\nproperty float x"), "1 2 3", "3 1 2 3"),
       ":11: error: the line ends where 'x' should follow"},
      {"ListLengthNoNumber", "a.ply",
       replaced(ply("float x", "list uchar int a\nproperty float x"), "1 2 3", "-1 1 2 3"),
       ":11: error: the length of 'a' is '-1'; it must be a whole number from 0 to 9e15"},
      {"ShortVertices", "a.ply", faces.substr(0, faces.size() - 1),
       at(header, 0, "the file ends within 2 elements 'vertex'")},
      {"ShortLength", "a.ply", faces + face,
       at(faces, 9, "the file ends within 2 elements 'face'")},
      {"ShortFace", "a.ply", faces + face + "\2aaaabbb",
       at(faces, 9, "the file ends within 2 elements 'face'")},
      {"NegativeLength", "a.ply", faces + face + "\xff",
       at(faces, 9, "the length of list 'corners' is -1; it must be at least 0")},
      {"MoreFaces", "a.ply", faces + face + face + "\0"s,
       at(faces, 18, "more follows after the last element of the header")},
  };
}

std::vector<BadFile> xyzFiles() {
  const std::string number = "; it must be a number that a double can hold";
  return {
      {"Names", "a.xyz", "x y z\n1 2 3\n", ":1: error: x is 'x'" + number},
      {"Hexadecimal", "a.xyz", "1 2 3\n1 0x10 3\n", ":2: error: y is '0x10'" + number},
      {"TwoSigns", "a.xyz", "1 2 +-3\n", ":1: error: z is '+-3'" + number},
      {"Garbage", "a.xyz", "\n\n1 2 3\v\n", ":3: error: z is '3?'" + number},
      {"EmptyNumber", "a.xyz", "1,,3\n", ":1: error: y is ''" + number},
      {"TwoNumbers", "a.xyz", "1 2 3\n1 2\n", ":2: error: the line ends where z should follow"},
      {"OpenEnd", "a.xyz", "1,2,\n", ":1: error: the line ends where z should follow"},
      {"DecimalComma", "a.xyz", "1,5 2,5 3,5\n",
       ":1: error: ',' is between x and y, but ' ' between y and z; it must be the same"},
      {"DecimalCommaAndSemicolon", "a.xyz", "1,5;2,5;3,5\n",
       ":1: error: ',' is between x and y, but ';' between y and z; it must be the same"},
      {"OnlyComments", "a.xyz", "# 1 2 3\n\n", ": error: the file has no points"},
      {"NothingFinite", "a.xyz", "nan 2 3\n", ": error: none of its 1 points is finite"},
      {"LongLine", "a.xyz", "1 2 3\n1 2 3" + std::string(1 << 20, ' '),
       ":2: error: the line has more than 1048576 bytes, which is the most allowed"},
  };
}

std::vector<BadFile> endings() {
  const std::string allowed = " of a file of points; allowed are .pcd, .ply and .xyz";
  return {
      {"Ending", "a.pcl", "", ": error: unknown ending '.pcl'" + allowed},
      {"NoEnding", "a", "", ": error: unknown ending ''" + allowed},
      {"TreeEnding", "a.bt", "", ": error: the file is empty"},
  };
}

std::vector<BadFile> allFiles() {
  std::vector<BadFile> all;
  const std::vector<std::pair<std::string, std::vector<BadFile>>> lists{
      {"PcdHeader", pcdHeaders()}, {"PcdData", pcdData()}, {"Pcd", bombs()},
      {"PlyHeader", plyHeaders()}, {"PlyData", plyData()}, {"Xyz", xyzFiles()},
      {"Any", endings()}};
  for (const auto& [prefix, list] : lists) {
    for (BadFile file : list) {
      file.name = prefix + file.name;
      all.push_back(std::move(file));
    }
  }
  return all;
}

class BadCloudFiles : public ::testing::TestWithParam<BadFile> {};

TEST_P(BadCloudFiles, GiveTheirMessage) {
  test::expectMessage(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Files, BadCloudFiles, ::testing::ValuesIn(allFiles()),
                         [](const auto& test) { return test.param.name; });

TEST(MissingCloudFiles, AreNamed) {
  const test::TemporaryFolder folder;
  for (const std::string name : {"a.pcd", "a.ply", "a.xyz", "a.bt", "a.ot"}) {
    const std::string path = (folder.path() / name).string();
    EXPECT_EQ(test::inputError([&] { load(path); }), path + ": error: file not found");
    fs::create_directory(path);
    EXPECT_EQ(test::inputError([&] { load(path); }), path + ": error: not a regular file");
  }
  const std::string path = (folder.path() / "a.txt").string();
  EXPECT_EQ(test::inputError([&] { loadOctomap(path); }),
            path + ": error: unknown ending '.txt' of an OctoMap file; allowed are .bt and .ot");
}

TEST(LargeCloudFiles, AreRefusedBeforeTheyAreRead) {
  const test::TemporaryFolder folder;
  for (const std::string name : {"a.pcd", "a.ply", "a.xyz", "a.bt", "a.ot"}) {
    const std::string path = folder.write(name, "x").string();
    fs::resize_file(path, std::uintmax_t{1} << 40);  // without anything on the disk
    EXPECT_EQ(test::inputError([&] { load(path); }),
              path + ": error: the file has 1099511627776 bytes; at most 2147483647 are allowed");
  }
}

}  // namespace
}  // namespace swept
