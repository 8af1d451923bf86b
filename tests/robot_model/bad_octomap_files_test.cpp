// SPDX-License-Identifier: BSD-3-Clause
//
// Broken files of OctoMap, and the exact messages they give.
#include "bad_cloud_files.hpp"

namespace swept {
namespace {

using namespace std::string_literals;
using test::at;
using test::BadFile;
using test::replaced;
using test::times;

const std::string kTree = "# Octomap OcTree file\nid OcTree\nsize 2\nres 0.1\ndata\n";
const std::string kTreeBits = "# Octomap OcTree binary file\nid OcTree\nsize 3\nres 0.1\ndata\n";

std::string tree(const std::string& from, const std::string& to) {
  return replaced(kTree, from, to);
}

std::vector<BadFile> treeHeaders() {
  const std::string sizes = "; it must be a number from 1e-09 to 1e+06";
  return {
      {"NoTree", "a.ot", "Octomap\n",
       ":1: error: the first line is 'Octomap'; it must be '# Octomap OcTree file'"},
      {"BinaryNamedFull", "a.ot", kTreeBits,
       ":1: error: the first line is '# Octomap OcTree binary file'; it must be '# Octomap OcTree "
       "file'"},
      {"FullNamedBinary", "a.bt", kTree,
       ":1: error: the first line is '# Octomap OcTree file'; it must be '# Octomap OcTree binary "
       "file'"},
      {"OtherId", "a.ot", tree("id OcTree", "id OcTreeStamped"),
       ":2: error: id is 'OcTreeStamped'; allowed are OcTree and ColorOcTree"},
      {"NegativeSize", "a.ot", tree("size 2", "size -2"),
       ":3: error: size is '-2'; it must be a whole number from 0 to 9e15"},
      {"ZeroResolution", "a.ot", tree("0.1", "0"), ":4: error: res is '0'" + sizes},
      {"HugeResolution", "a.ot", tree("0.1", "1e7"), ":4: error: res is '1e7'" + sizes},
      {"ResolutionNoNumber", "a.ot", tree("0.1", "nan"), ":4: error: res is 'nan'" + sizes},
      {"UnknownEntry", "a.ot", tree("res", "resolution"),
       ":4: error: unknown entry 'resolution' of an OctoMap header; allowed are id, res, size and "
       "data"},
      {"TwoValues", "a.ot", tree("0.1", "0.1 m"), ":4: error: res must have one value behind it"},
      {"Twice", "a.ot", tree("res 0.1", "size 3"),
       ":4: error: a second entry size; one is allowed"},
      {"NoId", "a.ot", tree("id OcTree\n", ""), ":4: error: the header has no entry id"},
      {"NoSize", "a.ot", tree("size 2\n", ""), ":4: error: the header has no entry size"},
      {"NoResolution", "a.ot", tree("res 0.1\n", ""), ":4: error: the header has no entry res"},
      {"NoData", "a.ot", tree("data\n", "# data\n"),
       ":5: error: the file ends where an entry data of its header should follow"},
  };
}

std::vector<BadFile> treeData() {
  const std::string root = "\0\0\0\0\1"s;
  const std::string leaf = "\0\0\0\0\0"s;
  const std::string deep = tree("size 2", "size 18");
  const std::string bits = replaced(kTreeBits, "size 3", "size 17");
  const std::string few = "the file ends within its nodes; the header says ";
  const std::string levels = "a node has children below level 16, which is the last one";
  return {
      {"NoNodes", "a.ot", kTree, at(kTree, 0, few + "2")},
      {"ShortNode", "a.ot", kTree + root + leaf.substr(1), at(kTree, 5, few + "2")},
      {"MissingNode", "a.ot", tree("size 2", "size 3") + root + leaf,
       at(kTree, 10, "the data end after 2 nodes; the header says 3")},
      {"MoreBehind", "a.ot", kTree + root + leaf + "\0"s,
       at(kTree, 10, "more follows after the last node")},
      {"EmptyWithData", "a.ot", tree("size 2", "size 0") + leaf,
       at(kTree, 0, "more follows after the last node")},
      {"NotANumber", "a.ot", kTree + root + "\0\0\xc0\x7f\0"s,
       at(kTree, 5, "the log odds of a node are not a number")},
      {"TooDeep", "a.ot", deep + times(17, root) + leaf, at(deep, 80, levels)},
      {"ShortBits", "a.bt", kTreeBits + "\3\0\2"s, at(kTreeBits, 2, few + "3")},
      {"BitsWithoutChildren", "a.bt", kTreeBits + "\3\0\0\0"s,
       at(kTreeBits, 2, "a node that should have children has none")},
      {"BitsMissing", "a.bt", kTreeBits + "\2\0"s,
       at(kTreeBits, 2, "the data end after 2 nodes; the header says 3")},
      {"BitsTooDeep", "a.bt", bits + times(17, "\3\0"s), at(bits, 32, levels)},
  };
}

class BadOctomapFiles : public ::testing::TestWithParam<BadFile> {};

TEST_P(BadOctomapFiles, GiveTheirMessage) {
  test::expectMessage(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Headers, BadOctomapFiles, ::testing::ValuesIn(treeHeaders()),
                         [](const auto& test) { return test.param.name; });
INSTANTIATE_TEST_SUITE_P(Nodes, BadOctomapFiles, ::testing::ValuesIn(treeData()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace swept
