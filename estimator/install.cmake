# `cmake --install` of the estimator, the part of touchdown that goes to a robot. Afterwards
# find_package(touchdown) gives touchdown::estimator; npz/CMakeLists.txt adds touchdown::models.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Programs include <touchdown/estimator.hpp> or <touchdown/estimator/…>. The headers include each other
# as "estimator/…".
set(public
  c_handle contact_estimator free_fall members record signal_assembler signal_bounds signal_guard signals stopped_signals
  torque_channel upkie_observer
  bayes/config bayes/filter bayes/measurement_fit bayes/measurement_model bayes/measurement_only
  bayes/transition_model
  force/closed_legs force/leg_geometry force/linkage force/load_filter
  models/arrays models/make_estimator models/metadata models/model
  neural/estimator neural/input neural/network)
# The headers of types that these hold by value. They are not for programs and may change.
set(detail
  bayes/noisy_measurement bayes/recursion
  force/dynamic_loads
  neural/forward numerics/axis
  numerics/exponential numerics/noise_estimate
  numerics/sliding_dft)
set(include_dir ${CMAKE_INSTALL_INCLUDEDIR}/touchdown)
target_include_directories(touchdown_estimator PUBLIC
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
  $<INSTALL_INTERFACE:${include_dir}>
  $<INSTALL_INTERFACE:${include_dir}/detail>)
set_target_properties(touchdown_estimator PROPERTIES EXPORT_NAME estimator)

install(TARGETS touchdown_estimator EXPORT touchdownTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES estimator.hpp touchdown.h DESTINATION ${include_dir})
install(FILES touchdown.h DESTINATION ${include_dir}/estimator)
foreach(header ${public})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header}.hpp DESTINATION ${include_dir}/estimator/${folder})
endforeach()
foreach(header ${detail})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header}.hpp DESTINATION ${include_dir}/detail/estimator/${folder})
endforeach()
# Programs written for version 1.0 include these headers by their former names.
foreach(renamed assembly/record.hpp=record.hpp assembly/signal_assembler.hpp=signal_assembler.hpp
        c_interface/handle.hpp=c_handle.hpp c_interface/touchdown.h=touchdown.h
        models/compiled.hpp=models/make_estimator.hpp)
  string(REPLACE "=" ";" names ${renamed})
  list(GET names 0 former)
  list(GET names 1 present)
  set(forwarder ${CMAKE_CURRENT_BINARY_DIR}/forwarders/${former})
  file(CONFIGURE OUTPUT ${forwarder} CONTENT "#include \"touchdown/estimator/${present}\"\n")
  cmake_path(GET former PARENT_PATH folder)
  install(FILES ${forwarder} DESTINATION ${include_dir}/estimator/${folder})
endforeach()
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/../core/error.hpp
        DESTINATION ${include_dir}/core)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/touchdown)
install(EXPORT touchdownTargets NAMESPACE touchdown:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/touchdownConfig.cmake.in
                              ${CMAKE_CURRENT_BINARY_DIR}/touchdownConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/touchdownConfigVersion.cmake
                                 VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/touchdownConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/touchdownConfigVersion.cmake
        DESTINATION ${package_dir})
