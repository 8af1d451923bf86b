# SPDX-License-Identifier: BSD-3-Clause
# Makes a C++ source (OUT) that holds FILES (a list), as they are, for src/page/page_files.hpp.
set(texts "")
set(table "")
set(number 0)
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND texts "constexpr char kText${number}[] = R\"swept_page(${text})swept_page\";\n")
  string(APPEND table "    {\"${name}\", {kText${number}, sizeof kText${number} - 1}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUT}" "// Made by embed.cmake.
#include \"page/page_files.hpp\"

namespace swept {
namespace {

${texts}
constexpr PageFile kFiles[] = {
${table}};

}  // namespace

std::span<const PageFile> pageFiles() {
  return kFiles;
}

}  // namespace swept
")
