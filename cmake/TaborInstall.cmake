# Install and export: find_package(tabor) gives tabor::tabor and one target per module.
include(CMakePackageConfigHelpers)
# The verbs of the command line (module cli) are the program's own.
get_property(modules GLOBAL PROPERTY TABOR_MODULES)
list(REMOVE_ITEM modules tabor_cli)
set(archives EXPORT taborTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TABOR_SHARED)
  # Modules are names of the shared library.
  list(TRANSFORM modules REPLACE "tabor_" "" OUTPUT_VARIABLE names)
  list(JOIN names " " TABOR_NAMES_OF_SHARED)
  set(archives ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT archives EXCLUDE_FROM_ALL)
  tabor_install_levels(${CMAKE_INSTALL_LIBDIR})
  install(TARGETS tabor_shared EXPORT taborTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
foreach(target IN LISTS modules)
  get_target_property(sets ${target} INTERFACE_HEADER_SETS)
  set(headers)
  if(sets)
    set(headers FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  endif()
  install(TARGETS ${target} ${archives} ${headers})
endforeach()
install(TARGETS tabor_all EXPORT taborTargets FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT taborTargets NAMESPACE tabor:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tabor)
configure_package_config_file(cmake/tabor-config.cmake.in ${PROJECT_BINARY_DIR}/tabor-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tabor)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tabor-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tabor-config.cmake ${PROJECT_BINARY_DIR}/tabor-config-version.cmake
        cmake/TaborDependencies.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tabor)
