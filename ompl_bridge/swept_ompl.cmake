# SPDX-License-Identifier: BSD-3-Clause
# For the build and for sweptConfig.cmake: OMPL 1.5 gives lists of folders and libraries. As a target they are looked up
# where a program is built, and not written into what is installed.
if(NOT TARGET swept::ompl)
  add_library(swept::ompl INTERFACE IMPORTED)
  set_target_properties(swept::ompl PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${OMPL_INCLUDE_DIRS}"
    INTERFACE_LINK_LIBRARIES "${OMPL_LIBRARIES}")
endif()
