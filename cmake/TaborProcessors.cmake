# Which processors the code runs on (docs/install.md, docs/decisions/030-several-processors.md).
set(TABOR_PROCESSORS native CACHE STRING "Compile for this machine's processor (native), for any of its kind (any), or for any
with code for newer ones beside it (several)")
set_property(CACHE TABOR_PROCESSORS PROPERTY STRINGS native any several)
if(NOT TABOR_PROCESSORS MATCHES "^(native|any|several)$")
  message(FATAL_ERROR "TABOR_PROCESSORS is '${TABOR_PROCESSORS}'; it can be native, any or several")
endif()

set(TABOR_LEVELS "")
if(TABOR_PROCESSORS STREQUAL "native")
  add_compile_options(-march=native)
elseif(TABOR_PROCESSORS STREQUAL "several" AND CMAKE_SYSTEM_NAME STREQUAL "Linux" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(TABOR_LEVELS x86-64-v3)  # AVX2 and fused multiply-add
endif()

# Shared libraries take the place of static ones where the dynamic loader is to choose among several.
string(COMPARE EQUAL "${TABOR_PROCESSORS}" "several" TABOR_SHARED)

# tabor_shared_library(<target> <objects...>): one build of libtabor from objects of all modules. The linker keeps the
# first copy of an inline function it meets.
function(tabor_shared_library target)
  add_library(${target} SHARED ${ARGN})
  get_property(foreign GLOBAL PROPERTY TABOR_FOREIGN_LIBRARIES)
  target_link_libraries(${target} PRIVATE ${foreign})
  # A release may change types of the library: SameMinorVersion in TaborInstall.cmake.
  set_target_properties(${target} PROPERTIES OUTPUT_NAME tabor LINKER_LANGUAGE CXX
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
    # Calls inside the library go to its own functions, not to copies that a program was compiled with.
    target_link_options(${target} PRIVATE LINKER:-Bsymbolic-functions LINKER:-z,defs)
  endif()
endfunction()

# The libraries of all levels, where the dynamic loader looks for them: below glibc-hwcaps beside the library for any
# processor, tabor_shared.
function(tabor_shared_libraries)
  get_property(modules GLOBAL PROPERTY TABOR_MODULES)
  set(objects "")
  foreach(module IN LISTS modules)
    get_target_property(type ${module} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
      list(APPEND objects $<TARGET_OBJECTS:${module}>)
    endif()
  endforeach()
  tabor_shared_library(tabor_shared ${objects})
  set_target_properties(tabor_shared PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
  foreach(level IN LISTS TABOR_LEVELS)
    get_property(objects GLOBAL PROPERTY TABOR_OBJECTS_${level})
    get_property(once GLOBAL PROPERTY TABOR_OBJECTS_ANY_PROCESSOR)
    tabor_shared_library(tabor_shared_${level} ${objects} ${once})
    set_target_properties(tabor_shared_${level} PROPERTIES
      LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/glibc-hwcaps/${level})
    add_dependencies(tabor_shared tabor_shared_${level})
  endforeach()
  # What users of the library compile with is that of the module core.
  foreach(property COMPILE_DEFINITIONS COMPILE_FEATURES INCLUDE_DIRECTORIES)
    get_target_property(values tabor_core INTERFACE_${property})
    set_target_properties(tabor_shared PROPERTIES INTERFACE_${property} "${values}")
  endforeach()
  target_link_libraries(tabor_shared INTERFACE Eigen3::Eigen fmt::fmt)
  set_target_properties(tabor_shared PROPERTIES EXPORT_NAME library)
endfunction()

# Installs the libraries of all levels above the first to a folder; further arguments are those of install(TARGETS ... LIBRARY).
function(tabor_install_levels folder)
  foreach(level IN LISTS TABOR_LEVELS)
    install(TARGETS tabor_shared_${level} LIBRARY DESTINATION ${folder}/glibc-hwcaps/${level} NAMELINK_SKIP ${ARGN})
  endforeach()
endfunction()
