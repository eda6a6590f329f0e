# SPDX-License-Identifier: BSD-3-Clause
# Run at build time: SOURCE with the repository's commit filled in becomes RESULT, if that changes it.
set(FROND_GIT_COMMIT "")
set(FROND_GIT_DIRTY false)
find_package(Git QUIET)
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --short=12 HEAD WORKING_DIRECTORY ${REPOSITORY}
                  OUTPUT_VARIABLE FROND_GIT_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${GIT_EXECUTABLE} status --porcelain --untracked-files=no WORKING_DIRECTORY ${REPOSITORY}
                  OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT changes STREQUAL "")
    set(FROND_GIT_DIRTY true)
  endif()
endif()
configure_file(${SOURCE} ${RESULT} @ONLY)
