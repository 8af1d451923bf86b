# SPDX-License-Identifier: BSD-3-Clause
# cmake -DFOLDER=planners_demo/examples "-DEXAMPLES=LIST" -P examples.cmake
#
# Fails unless each example in the folder has less than 60 lines and is in LIST, the one of its CMakeLists.txt; unless these are
# numbered from 01 on; and unless each has a row in README.md with its target and the command that is its test.
cmake_minimum_required(VERSION 3.22)

function(complain text)
  message(SEND_ERROR "examples: ${text}")
endfunction()

file(READ ${FOLDER}/README.md readme)
file(GLOB files RELATIVE ${FOLDER} ${FOLDER}/*)
list(REMOVE_ITEM files CMakeLists.txt README.md)

set(number 0)
foreach(example IN LISTS EXAMPLES)
  separate_arguments(words UNIX_COMMAND "${example}")
  list(POP_FRONT words name component)
  math(EXPR number "${number} + 1")
  if(NOT name MATCHES "^0?${number}_")
    complain("${name} is number ${number} of the list")
  endif()

  if(component STREQUAL "swept")
    set(file ${name}.sh)
    set(target "`swept`")
    set(command "${file} build/release/planners_demo/swept")
  else()
    set(file ${name}.cpp)
    set(target "`swept::${component}`")
    list(JOIN words " " arguments)
    string(STRIP "example_${name} ${arguments}" command)
    set(command "`${command}`")
  endif()

  if(NOT file IN_LIST files)
    complain("there is no ${file}")
    continue()
  endif()
  list(REMOVE_ITEM files ${file})
  file(READ ${FOLDER}/${file} text)
  string(REGEX MATCHALL "\n" lines "${text}")
  list(LENGTH lines count)
  if(count GREATER_EQUAL 60)
    complain("${file} has ${count} lines; less than 60 are allowed")
  endif()

  string(REGEX MATCH "\n\\| \\[${name}\\]\\(${file}\\) \\|[^\n]*" row "${readme}")
  foreach(wanted IN ITEMS "${target}" "${command}")
    string(FIND "${row}" "${wanted}" at)
    if(at EQUAL -1)
      complain("README.md has no row of ${name} with ${wanted}")
    endif()
  endforeach()
endforeach()

foreach(file IN LISTS files)
  complain("${file} is not in the list of CMakeLists.txt")
endforeach()
