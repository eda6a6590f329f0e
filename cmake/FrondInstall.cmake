# SPDX-License-Identifier: BSD-3-Clause
# cmake --install: the program, the libraries, their headers by their own paths, and find_package(frond).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY FROND_LIBRARIES)
install(TARGETS ${libraries} EXPORT frond-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT frond-targets NAMESPACE frond:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/frond)
install(DIRECTORY base models solvers problems io experiments DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/frond
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/frond)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
configure_package_config_file(cmake/frond-config.cmake.in ${PROJECT_BINARY_DIR}/frond-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/frond)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/frond-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/frond-config.cmake ${PROJECT_BINARY_DIR}/frond-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/frond)
