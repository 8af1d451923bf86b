# SPDX-License-Identifier: BSD-3-Clause
# .deb packages, one of each part that is installed, with shared libraries:
#   cmake --preset deb && cmake --build --preset deb --target package
# A program that needs the core alone is built with libswept-core-dev, which brings no package that the core has no use for.
if(is_static)
  return()
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL)
set(CPACK_STRIP_FILES ON)
set(SWEPT_PACKAGER "the swept authors" CACHE STRING "Who hands out the .deb packages: Name <mail address>")
set(CPACK_PACKAGE_CONTACT "${SWEPT_PACKAGER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # which would come before that of each package
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
  ${PROJECT_BINARY_DIR}/core ${PROJECT_BINARY_DIR}/robot_model ${PROJECT_BINARY_DIR}/robot_model/proofs
  ${PROJECT_BINARY_DIR}/robot_model/pages
  ${PROJECT_BINARY_DIR}/ompl_bridge)

# swept_package(PART NAME package SECTION section SUMMARY "one line" [OF parts] [DEPENDS "others' packages"]
#   [RECOMMENDS package]): PART is of install().
macro(swept_package part)
  cmake_parse_arguments(PACKAGE "" "NAME;SECTION;SUMMARY;DEPENDS;RECOMMENDS" OF ${ARGN})
  string(TOUPPER ${part} id)
  list(APPEND CPACK_COMPONENTS_ALL ${part})
  set(CPACK_COMPONENT_${id}_DEPENDS ${PACKAGE_OF})
  set(CPACK_DEBIAN_${id}_DESCRIPTION "${PACKAGE_SUMMARY}
Tells a motion planner whether a robot state, or a whole motion between two
states, is free of collision on exact geometry: proven, rounding included.")
  set(CPACK_DEBIAN_${id}_PACKAGE_NAME ${PACKAGE_NAME})
  set(CPACK_DEBIAN_${id}_PACKAGE_SECTION ${PACKAGE_SECTION})
  set(CPACK_DEBIAN_${id}_PACKAGE_DEPENDS "${PACKAGE_DEPENDS}")
  set(CPACK_DEBIAN_${id}_PACKAGE_RECOMMENDS "${PACKAGE_RECOMMENDS}")
  set(CPACK_DEBIAN_${id}_PACKAGE_SHLIBDEPS ON)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/copyright ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${PACKAGE_NAME} COMPONENT ${part} EXCLUDE_FROM_ALL)
endmacro()

# The shared library, and what building with it takes; `others`: packages of the latter.
macro(swept_library_packages component summary others)
  string(REPLACE "_" "-" name libswept-${component})
  swept_package(${component} NAME ${name}${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} SECTION libs
    SUMMARY "${summary}" OF ${ARGN})
  # The latter two are no files: with their names CPack makes none, which would call ldconfig besides, and be left behind
  # by `dpkg -r`.
  set(CPACK_DEBIAN_${id}_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/triggers
    ${CMAKE_CURRENT_BINARY_DIR}/none/postinst ${CMAKE_CURRENT_BINARY_DIR}/none/postrm)
  set(below ${ARGN})
  list(TRANSFORM below APPEND _dev)
  swept_package(${component}_dev NAME ${name}-dev SECTION libdevel SUMMARY "${summary} - development files"
    OF ${component} ${below} DEPENDS "${others}")
endmacro()

file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
file(READ ${PROJECT_SOURCE_DIR}/robot_model/pages/page/three_licence.txt three_licence)
configure_file(copyright.in copyright @ONLY)
set(changelog_packager "${SWEPT_PACKAGER}")
if(NOT changelog_packager MATCHES "<")
  string(APPEND changelog_packager " <>")  # without which a changelog cannot be read
endif()
string(TIMESTAMP changelog_date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of $SOURCE_DATE_EPOCH, if that is set
configure_file(changelog.in changelog @ONLY)
add_custom_command(OUTPUT changelog.gz COMMAND gzip -9nkf changelog DEPENDS changelog VERBATIM)
add_custom_target(swept_changelog ALL DEPENDS changelog.gz)

swept_library_packages(core "proven distances and first contacts of shapes" libeigen3-dev)
if(TARGET swept_robot_model)
  swept_library_packages(robot_model "proven verdicts on motions of URDF robots" "" core)
endif()
if(TARGET swept_proofs)
  swept_library_packages(proofs "proofs of robot paths that others can check" "" robot_model)
endif()
set(pages)
if(TARGET swept_pages)
  set(pages pages)
  swept_library_packages(pages "pages of robots and proven motions" "" robot_model)
endif()
if(TARGET swept_ompl_bridge)
  # OMPL's CMake file names the three Boost libraries.
  swept_library_packages(ompl_bridge "OMPL classes over proven motions"
    "libompl-dev, libboost-serialization-dev, libboost-filesystem-dev, libboost-system-dev" robot_model)
endif()
if(TARGET swept_python)
  get_target_property(python_packages swept_python SWEPT_DEBIAN_DEPENDS)
  swept_package(python NAME python3-swept SECTION python SUMMARY "proven motions of robots in Python"
    OF ompl_bridge proofs ${pages} DEPENDS "${python_packages}")
endif()
if(TARGET swept)
  swept_package(program NAME swept SECTION science SUMMARY "plans, checks and proves robot motions"
    OF ompl_bridge proofs ${pages})
endif()
if(TARGET swept_mpi)
  swept_package(program_mpi NAME swept-mpi SECTION science SUMMARY "swept for batches on MPI jobs"
    OF ompl_bridge proofs ${pages} RECOMMENDS openmpi-bin)
endif()
include(CPack)
