# Installs the estimator alone from SOURCE_DIR, builds the example project against what was
# installed, and runs it. Everything happens below WORK_DIR.

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(JOIN " " command ${ARGV})
    message(FATAL_ERROR "${command}\nfailed with ${result}:\n${output}")
  endif()
  message(STATUS "${output}")
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/library -G ${GENERATOR}
    -DTOUCHDOWN_ESTIMATOR_ONLY=ON -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/library)
run(${CMAKE_COMMAND} --install ${WORK_DIR}/library --prefix ${WORK_DIR}/prefix)

# A copy, so that nothing of the source tree can be found by accident.
file(COPY ${SOURCE_DIR}/examples/control_loop DESTINATION ${WORK_DIR})
run(${CMAKE_COMMAND} -S ${WORK_DIR}/control_loop -B ${WORK_DIR}/example -G ${GENERATOR}
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX}
    -DCMAKE_CXX_FLAGS=${EXAMPLE_FLAGS} -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/example)
run(${WORK_DIR}/example/control_loop)

file(GLOB_RECURSE configs ${WORK_DIR}/prefix/*.cmake)
foreach(config ${configs})
  file(READ ${config} text)
  string(FIND "${text}" "${SOURCE_DIR}/estimator" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${config} mentions the source tree")
  endif()
endforeach()
