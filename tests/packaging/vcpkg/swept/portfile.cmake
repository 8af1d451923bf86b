# SPDX-License-Identifier: BSD-3-Clause
# Port of swept for vcpkg, of the tree that this file is in:
#   vcpkg install swept --overlay-ports=tests/packaging/vcpkg
# The component pages is left out, and so is the Python package: pages contain three.js, which is no library of C++.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS features
  FEATURES
    program SWEPT_BUILD_PROGRAM
  INVERTED_FEATURES
    # So that none of the system's own is found instead.
    robot-model CMAKE_DISABLE_FIND_PACKAGE_urdfdom
    proofs CMAKE_DISABLE_FIND_PACKAGE_OpenSSL
    ompl-bridge CMAKE_DISABLE_FIND_PACKAGE_ompl)

vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${features}
    -DSWEPT_BUILD_PYTHON=OFF
    -DSWEPT_BUILD_TESTS=OFF
    -DSWEPT_INSTALL=ON
    -DSWEPT_THREE_FOLDER=OFF
    -DCMAKE_DISABLE_FIND_PACKAGE_fcl=ON
    -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON
  MAYBE_UNUSED_VARIABLES
    CMAKE_DISABLE_FIND_PACKAGE_fcl
    CMAKE_DISABLE_FIND_PACKAGE_MPI
    CMAKE_DISABLE_FIND_PACKAGE_ompl
    CMAKE_DISABLE_FIND_PACKAGE_OpenSSL
    SWEPT_THREE_FOLDER)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME swept CONFIG_PATH lib/cmake/swept)
vcpkg_fixup_pkgconfig()
if("program" IN_LIST FEATURES)
  vcpkg_copy_tools(TOOL_NAMES swept AUTO_CLEAN)
endif()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share"
  "${CURRENT_PACKAGES_DIR}/share/doc" "${CURRENT_PACKAGES_DIR}/share/man")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
