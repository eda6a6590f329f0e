# SPDX-License-Identifier: BSD-3-Clause
# frond_add_library(name SOURCES a.cc … DEPENDS targets …): the library frond::name of one folder.
# Headers are included by their path from the repository's root ("models/nurbs_surface.h").
function(frond_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(frond_${name} STATIC ${ARG_SOURCES})
  add_library(frond::${name} ALIAS frond_${name})
  set_target_properties(frond_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(frond_${name} PUBLIC cxx_std_20)
  target_include_directories(frond_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                  $<INSTALL_INTERFACE:include/frond>)
  target_link_libraries(frond_${name} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS})
  frond_compile_options(frond_${name})
  set_property(GLOBAL APPEND PROPERTY FROND_LIBRARIES frond_${name})
endfunction()

# Warnings and optional -march=native for a target of ours. FROND_NATIVE must be the same in every
# target: Eigen's alignment depends on it, hence PUBLIC.
function(frond_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 warns falsely of overlapping copies in std::string's operator+ at -O3 (GCC bug 105651).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(FROND_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(FROND_NATIVE)
    target_compile_options(${target} PUBLIC -march=native)
    # Objects of pagmo that hold Eigen matrices are freed here but allocated there, by libraries without AVX.
    target_compile_definitions(${target} PUBLIC EIGEN_MAX_ALIGN_BYTES=16)
  endif()
endfunction()

# frond_add_test(name SOURCES … DEPENDS …): one GoogleTest program, its cases known to ctest.
function(frond_add_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE FROND_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                             FROND_SHARED_DATA="${PROJECT_SOURCE_DIR}/../shared/data")
  frond_compile_options(${name})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
