# Builds the example project against the estimator that is installed in PREFIX, and runs it. Everything
# happens below WORK_DIR. With PROGRAM, the `touchdown` that was built, also the robot's program and the
# one in C, with a model that it fits.

include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

# Copies the example, so that its build cannot find the source tree by accident.
function(build_example folder)
  cmake_path(GET folder FILENAME name)
  file(COPY ${SOURCE_DIR}/${folder} DESTINATION ${WORK_DIR})
  run(${CMAKE_COMMAND} -S ${WORK_DIR}/${name} -B ${WORK_DIR}/build_${name} -G ${GENERATOR}
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX}
      -DCMAKE_CXX_FLAGS=${EXAMPLE_FLAGS} -DCMAKE_PREFIX_PATH=${PREFIX} ${ARGN})
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/build_${name})
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})

build_example(examples/control_loop)
run(${WORK_DIR}/build_control_loop/control_loop)
build_example(tests/installs/former_headers)
run(${WORK_DIR}/build_former_headers/former_headers)

if(PROGRAM)
  run(${PROGRAM} simulate ${SOURCE_DIR}/scenarios/stairs.yaml --run 1 -o stairs.mpack)
  run(${PROGRAM} fit stairs.mpack -o model.npz)
  run(${PROGRAM} convert model.npz -o model.hpp)
  build_example(examples/robot -DMODEL_HEADER=${WORK_DIR}/model.hpp)
  build_example(examples/c_interface)
  run(${WORK_DIR}/build_c_interface/c_interface model.npz)
  # With the model from the file or compiled in, the beliefs are equal to the last digit.
  run(${WORK_DIR}/build_robot/robot model.npz)
  string(REGEX REPLACE "update:.*" "" from_file "${output}")
  run(${WORK_DIR}/build_robot/robot_without_files)
  string(REGEX REPLACE "update:.*" "" compiled_in "${output}")
  if(NOT from_file MATCHES "takes off, P\\(contact\\) 0\\.[0-9]+" OR NOT from_file STREQUAL compiled_in)
    message(FATAL_ERROR "from the file:\n${from_file}\ncompiled in:\n${compiled_in}")
  endif()
  # A model of another robot stops the program before the robot moves.
  run(${PROGRAM} fit stairs.mpack --robot tall -o tall.npz)
  execute_process(COMMAND ${WORK_DIR}/build_robot/robot ${WORK_DIR}/tall.npz
                  RESULT_VARIABLE result ERROR_VARIABLE output)
  if(result EQUAL 0 OR NOT output MATCHES "tall.npz: was fitted to the robot 'tall', not to 'upkie'")
    message(FATAL_ERROR "expected a refusal of tall.npz, found ${result}: ${output}")
  endif()
endif()
