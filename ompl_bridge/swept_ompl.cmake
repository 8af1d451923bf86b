# SPDX-License-Identifier: BSD-3-Clause
# For the build and for sweptConfig.cmake: OMPL 1.5 and 1.6 give lists of folders and libraries. As a target they are
# looked up where a program is built, and not written into what is installed. OMPL 1.6 of Debian 13 also names folders of
# the machine that built it, which CMake would refuse: only those that exist are taken.
if(NOT TARGET swept::ompl)
  set(swept_ompl_folders ${OMPL_INCLUDE_DIRS})
  foreach(folder ${OMPL_INCLUDE_DIRS})
    if(NOT IS_DIRECTORY "${folder}")
      list(REMOVE_ITEM swept_ompl_folders "${folder}")
    endif()
  endforeach()
  add_library(swept::ompl INTERFACE IMPORTED)
  set_target_properties(swept::ompl PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${swept_ompl_folders}"
    INTERFACE_LINK_LIBRARIES "${OMPL_LIBRARIES}")
endif()
