# SPDX-License-Identifier: BSD-3-Clause
# For the build and for sweptConfig.cmake: swept calls console_bridge, which urdfdom reports errors with. Up to 3 urdfdom's
# target brings it, 4 keeps it to itself.
if(TARGET urdfdom::urdfdom_model)
  get_target_property(swept_urdfdom_links urdfdom::urdfdom_model INTERFACE_LINK_LIBRARIES)
  if(NOT "console_bridge::console_bridge" IN_LIST swept_urdfdom_links)
    find_package(console_bridge QUIET CONFIG)
    if(TARGET console_bridge::console_bridge)
      set_property(TARGET urdfdom::urdfdom_model APPEND PROPERTY INTERFACE_LINK_LIBRARIES console_bridge::console_bridge)
    endif()
  endif()
endif()
