# Install and export: find_package(tabor) gives tabor::tabor and one target per module.
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY TABOR_MODULES)
install(TARGETS ${modules} tabor_all EXPORT taborTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/tabor/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tabor FILES_MATCHING PATTERN "*.hpp"
        PATTERN "hdf5_library.hpp" EXCLUDE PATTERN "fftw_library.hpp" EXCLUDE)
install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/tabor/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tabor)
install(EXPORT taborTargets NAMESPACE tabor:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tabor)
configure_package_config_file(cmake/tabor-config.cmake.in ${PROJECT_BINARY_DIR}/tabor-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tabor)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tabor-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tabor-config.cmake ${PROJECT_BINARY_DIR}/tabor-config-version.cmake
        cmake/TaborDependencies.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tabor)
