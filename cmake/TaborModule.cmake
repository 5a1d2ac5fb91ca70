# tabor_module(<name> [NO_HOT_LOOPS] [ANY_PROCESSOR] SOURCES ... [DEPENDS modules...] [PUBLIC targets...] [PRIVATE targets...]
#              [PUBLIC_HEADERS headers...])
#
# One static library per folder of src/tabor. A module links the modules it names and nothing else,
# so that the layer table of docs/architecture.md also holds at link time. Public headers are
# installed; all others are for this tree alone. One with NO_HOT_LOOPS is not optimised with sanitizers: that
# would take longer than all runs of the tests. One with NO_HOT_LOOPS or ANY_PROCESSOR gains nothing from newer
# processors and is compiled once for all of them (TABOR_PROCESSORS=several).
function(tabor_module name)
  cmake_parse_arguments(ARG "NO_HOT_LOOPS;ANY_PROCESSOR" "" "SOURCES;DEPENDS;PUBLIC;PRIVATE;PUBLIC_HEADERS" ${ARGN})
  set(target tabor_${name})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    set(scope PUBLIC)
    target_compile_options(${target} PRIVATE ${TABOR_COMPILE_OPTIONS})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(${target} PRIVATE ${ARG_PRIVATE})
    tabor_unity(${target})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(tabor::${name} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY TABOR_MODULES ${target})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  if(TABOR_FUZZ AND ARG_NO_HOT_LOOPS)
    target_compile_options(${target} PRIVATE -O0)
    if(TABOR_PRECOMPILED)
      target_precompile_headers(${target} REUSE_FROM tabor_module_headers_plain)
    endif()
  elseif(TABOR_PRECOMPILED AND ARG_SOURCES AND "core" IN_LIST ARG_DEPENDS)
    target_precompile_headers(${target} REUSE_FROM tabor_module_headers)
  endif()
  list(TRANSFORM ARG_DEPENDS PREPEND tabor::)
  target_link_libraries(${target} ${scope} ${ARG_DEPENDS} ${ARG_PUBLIC})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  tabor_public_headers(${target} ${scope} ${name} ${ARG_PUBLIC_HEADERS})
  if(ARG_SOURCES AND TABOR_SHARED)
    set_property(GLOBAL APPEND PROPERTY TABOR_FOREIGN_LIBRARIES ${ARG_PUBLIC} ${ARG_PRIVATE})
    if(ARG_NO_HOT_LOOPS OR ARG_ANY_PROCESSOR)
      set_property(GLOBAL APPEND PROPERTY TABOR_OBJECTS_ANY_PROCESSOR $<TARGET_OBJECTS:${target}>)
    else()
      tabor_module_levels(${target} SOURCES ${ARG_SOURCES} LINK ${ARG_PRIVATE})
    endif()
  endif()
endfunction()

# Compiles the sources of a module once more for each level of processors (TABOR_LEVELS).
function(tabor_module_levels target)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  foreach(level IN LISTS TABOR_LEVELS)
    set(objects ${target}_${level})
    add_library(${objects} OBJECT ${ARG_SOURCES})
    target_compile_options(${objects} PRIVATE ${TABOR_COMPILE_OPTIONS} -march=${level})
    set_target_properties(${objects} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(${objects} PRIVATE ${target} ${ARG_LINK})
    get_target_property(header_target ${target} PRECOMPILE_HEADERS_REUSE_FROM)
    if(header_target)
      target_precompile_headers(${objects} REUSE_FROM ${header_target}_${level})
    endif()
    tabor_unity(${objects})
    set_property(GLOBAL APPEND PROPERTY TABOR_OBJECTS_${level} $<TARGET_OBJECTS:${objects}>)
  endforeach()
endfunction()

# Compiles up to eight sources of a target as one (TABOR_UNITY): what they all include and instantiate then costs once.
# Which go together is worked out anew at every configuring; a source may always be written as if it were compiled alone.
function(tabor_unity target)
  if(NOT TABOR_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "[.]cpp$")
  execute_process(COMMAND ${TABOR_UNITY_PYTHON} ${PROJECT_SOURCE_DIR}/cmake/unity_groups.py 8 ${sources}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE groups COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" groups "${groups}")
  foreach(group IN LISTS groups)
    string(REPLACE " " ";" members "${group}")
    list(GET members 0 name)
    string(MAKE_C_IDENTIFIER ${name} name)
    set_source_files_properties(${members} PROPERTIES UNITY_GROUP ${name})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# Installs these headers of a module with its target, and makes tabor/<name>.hpp, which includes them.
# A header that is not in the folder is a generated one.
function(tabor_public_headers target scope name)
  if(NOT ARGN)
    return()
  endif()
  set(generated ${PROJECT_BINARY_DIR}/generated)
  set(includes "")
  set(files ${generated}/tabor/${name}.hpp)
  foreach(header IN LISTS ARGN)
    string(APPEND includes "#include \"tabor/${name}/${header}\"\n")
    set_property(GLOBAL APPEND PROPERTY TABOR_PUBLIC_HEADERS tabor/${name}/${header})
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${header})
      list(APPEND files ${CMAKE_CURRENT_SOURCE_DIR}/${header})
    else()
      list(APPEND files ${generated}/tabor/${name}/${header})
    endif()
  endforeach()
  tabor_umbrella(${name} "The public headers of the module ${name}." "${includes}")
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src ${generated}
                 FILES ${files})
endfunction()

# Makes the header tabor/<name>.hpp, which only includes others.
function(tabor_umbrella name comment includes)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/tabor/${name}.hpp
       CONTENT "#pragma once\n\n// ${comment}\n${includes}")
  set_property(GLOBAL APPEND PROPERTY TABOR_UMBRELLAS tabor/${name}.hpp)
endfunction()

# Links all of the named modules before a program's own objects, and before each module those below it. The
# linker keeps the first copy of an inline function it meets: behind tests or a module that are not optimised,
# the others would run their slow copies (of Eigen, four times as long).
function(tabor_link_modules_first program)
  set(files)
  while(ARGN)
    list(POP_FRONT ARGN module)
    get_target_property(type ${module} TYPE)
    if("$<TARGET_FILE:${module}>" IN_LIST files OR NOT type STREQUAL "STATIC_LIBRARY")
      continue()
    endif()
    list(PREPEND files $<TARGET_FILE:${module}>)
    get_target_property(links ${module} INTERFACE_LINK_LIBRARIES)
    list(FILTER links INCLUDE REGEX "^tabor::")
    list(APPEND ARGN ${links})
  endwhile()
  target_link_options(${program} PRIVATE LINKER:--whole-archive ${files} LINKER:--no-whole-archive)
endfunction()

# A filter of the tests in these files whose first line ends with "// slow", or with sanitizers "// slow with sanitizers".
function(tabor_slow_tests filter)
  set(names)
  set(mark "// slow$")
  if(TABOR_FUZZ)
    set(mark "// slow( with sanitizers)?$")
  endif()
  foreach(source IN LISTS ARGN)
    file(STRINGS ${source} lines REGEX "^TEST.*${mark}")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^TEST[_FP]*\\(([A-Za-z0-9]+), ([A-Za-z0-9]+)\\).*" "\\1.\\2" test "${line}")
      list(APPEND names ${test} */${test}/*)  # alone, and with parameters
    endforeach()
  endforeach()
  list(JOIN names ":" names)
  set(${filter} "${names}" PARENT_SCOPE)
endfunction()

# tabor_test(<name> SOURCES ... LINK targets... [LABEL fast|slow])
#
# A test marked "// slow" among fast ones is slow: sanitizers would draw it out to minutes, and lighter
# tests enter its code as well.
function(tabor_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;LINK" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL fast)
  endif()
  if(ARG_LABEL STREQUAL "slow" AND NOT TABOR_SLOW_TESTS)
    return()
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_compile_options(${name} PRIVATE ${TABOR_TEST_OPTIONS})
  target_compile_definitions(${name} PRIVATE
    TABOR_SOURCE_DIR="${PROJECT_SOURCE_DIR}" TABOR_SHARED_SCANS="${PROJECT_SOURCE_DIR}/../shared/scans")
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${name} PRIVATE ${ARG_LINK} GTest::gmock_main)
  if(TABOR_PRECOMPILED)
    target_link_libraries(${name} PRIVATE tabor::core)  # compiled as these headers were
    target_precompile_headers(${name} REUSE_FROM tabor_test_headers)
  endif()
  if(TABOR_FUZZ)
    set(modules ${ARG_LINK})
    list(FILTER modules INCLUDE REGEX "^tabor::")
    tabor_link_modules_first(${name} ${modules})
  endif()
  tabor_unity(${name})
  tabor_slow_tests(slow ${ARG_SOURCES})
  set(discovery NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60)  # bytes of a value would be another name each time
  if(slow)
    gtest_discover_tests(${name} ${discovery} TEST_FILTER "${slow}" PROPERTIES LABELS slow COST 10)
    gtest_discover_tests(${name} ${discovery} TEST_FILTER "-${slow}" PROPERTIES LABELS ${ARG_LABEL})
  elseif(ARG_LABEL STREQUAL "slow")
    gtest_discover_tests(${name} ${discovery} PROPERTIES LABELS slow COST 10)
  else()
    gtest_discover_tests(${name} ${discovery} PROPERTIES LABELS ${ARG_LABEL})
  endif()
endfunction()

if(TABOR_UNITY)
  find_program(TABOR_UNITY_PYTHON python3 REQUIRED)
endif()

set(TABOR_COMPILE_OPTIONS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # gcc 12 reports its own AVX-512 intrinsics as uninitialised (gcc bug 105593).
  # It also sees overlapping copies in operator+ of strings (gcc bug 105651).
  list(APPEND TABOR_COMPILE_OPTIONS -Wno-maybe-uninitialized -Wno-restrict)
  if(TABOR_PRECOMPILED)
    # Nor does it know any more that precompiled headers of std are the system's, where it sees
    # accesses beyond arrays (gcc bug 105329), and 105593 turns up as -Wuninitialized with -O1.
    list(APPEND TABOR_COMPILE_OPTIONS
      -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread -Wno-uninitialized)
  endif()
  if(TABOR_UNITY)
    # Collecting its garbage below 600 MB takes a tenth of its time.
    add_compile_options("SHELL:--param ggc-min-heapsize=600000")
    # It takes a source that another file includes for a header, whose types no other source may hold.
    list(APPEND TABOR_COMPILE_OPTIONS -Wno-subobject-linkage)
  endif()
endif()
if(TABOR_WERROR)
  list(APPEND TABOR_COMPILE_OPTIONS -Werror)
endif()
# No -ffast-math anywhere: NaN marks holes. -ffp-contract=off keeps results the same on every target.
add_compile_options(-ffp-contract=off)
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache" AND TABOR_PRECOMPILED)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fpch-preprocess)
  else()
    add_compile_options("SHELL:-Xclang -fno-pch-timestamp")
  endif()
endif()
include(TaborProcessors)

set(TABOR_TEST_OPTIONS ${TABOR_COMPILE_OPTIONS})
# Tests take longer to compile than to run; coverage is for the fuzzer, which runs none of them.
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  list(APPEND TABOR_TEST_OPTIONS -O1)
elseif(TABOR_FUZZ)
  list(APPEND TABOR_TEST_OPTIONS -O0 -fno-sanitize=fuzzer-no-link)
endif()
