# Installs BUILD to a fresh prefix, compares what lies there with the list of public headers, then
# configures, builds and runs the projects CONSUMER and EXAMPLES with it.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(build source)
  run(${CMAKE_COMMAND} -S ${source} -B ${WORK}/${ARGV1} -G Ninja -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_FLAGS=${FLAGS})
  run(${CMAKE_COMMAND} --build ${WORK}/${ARGV1})
endfunction()

# What a program prints must match a regular expression.
function(run_example expected)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE printed)
  message("${printed}")
  if(NOT printed MATCHES "${expected}")
    message(FATAL_ERROR "expected ${expected}")
  endif()
endfunction()

set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} "${LAUNCHER}")
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
foreach(file man/man1/tabor.1 man/man1/tabor-contact.1 bash-completion/completions/tabor
        zsh/vendor-completions/_tabor fish/vendor_completions.d/tabor.fish)
  if(NOT EXISTS ${WORK}/prefix/share/${file})
    message(FATAL_ERROR "share/${file} is not installed")
  endif()
endforeach()
run(${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/public_headers.py ${HEADERS} ${WORK}/prefix/include)
build(${CONSUMER} consumer)
run(${WORK}/consumer/consumer)
build(${EXAMPLES} examples)
run_example("kappa +[12]\\.[0-9]+, between 1.60 and 2.51" ${WORK}/examples/contact_area)
# As examples/05_scan_to_friction/README.md has them.
run_example("10 MPa, 0.45 g/m.2: contact 4.17 %, wet share 9.68 %, friction dry 0.2976, wet 0.2688"
            ${WORK}/examples/scan_to_friction ${SURFACE})
