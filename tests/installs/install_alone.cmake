# Compiles the estimator alone from SOURCE_DIR and installs it in WORK_DIR/prefix.

include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/library -G ${GENERATOR}
    -DTOUCHDOWN_ESTIMATOR_ONLY=ON -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX}
    "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG") # faster to compile, as fast to run
run(${CMAKE_COMMAND} --build ${WORK_DIR}/library --parallel 1) # other tests run beside this one
run(${CMAKE_COMMAND} --install ${WORK_DIR}/library --prefix ${WORK_DIR}/prefix)

file(GLOB_RECURSE configs ${WORK_DIR}/prefix/*.cmake)
if(NOT configs)
  message(FATAL_ERROR "nothing for find_package was installed")
endif()
foreach(config ${configs})
  file(READ ${config} text)
  string(FIND "${text}" "${SOURCE_DIR}/" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${config} mentions the source tree")
  endif()
endforeach()
