# SPDX-License-Identifier: BSD-3-Clause
# For the build and for sweptConfig.cmake: yaml-cpp 0.8 may have the target yaml-cpp::yaml-cpp alone, 0.7 has yaml-cpp alone.
# swept links the older name.
if(TARGET yaml-cpp::yaml-cpp AND NOT TARGET yaml-cpp)
  add_library(yaml-cpp INTERFACE IMPORTED)
  set_target_properties(yaml-cpp PROPERTIES INTERFACE_LINK_LIBRARIES yaml-cpp::yaml-cpp)
endif()
