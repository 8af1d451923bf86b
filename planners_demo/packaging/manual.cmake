# SPDX-License-Identifier: BSD-3-Clause
# The manual pages: swept(1) is what the program says of itself, and so is made after it.
if(NOT TARGET swept OR CMAKE_CROSSCOMPILING)
  return()
endif()
string(TIMESTAMP manual_date "%Y-%m-%d" UTC)  # of $SOURCE_DATE_EPOCH, if that is set

# swept_manual(PAGE PART part SOURCES what it is made from MAKE the command that prints it)
function(swept_manual page)
  cmake_parse_arguments(MANUAL "" PART "SOURCES;MAKE" ${ARGN})
  add_custom_command(OUTPUT ${page}.gz
    COMMAND ${MANUAL_MAKE} > ${page}
    COMMAND gzip -9nf ${page}
    DEPENDS ${MANUAL_SOURCES} VERBATIM)
  add_custom_target(${page} ALL DEPENDS ${page}.gz)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${page}.gz
    DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${MANUAL_PART})
endfunction()

swept_manual(swept.1 PART program SOURCES swept manual.sh manual.awk
  MAKE ${CMAKE_CURRENT_SOURCE_DIR}/manual.sh $<TARGET_FILE:swept> ${manual_date})
if(TARGET swept_mpi)
  configure_file(swept-mpi.1.in swept-mpi.1.text @ONLY)
  swept_manual(swept-mpi.1 PART program_mpi SOURCES ${CMAKE_CURRENT_BINARY_DIR}/swept-mpi.1.text
    MAKE ${CMAKE_COMMAND} -E cat swept-mpi.1.text)
endif()
