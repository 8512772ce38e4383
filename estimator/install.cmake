# `cmake --install` of the estimator: what of touchdown goes to a robot. Afterwards
# find_package(touchdown) gives touchdown::estimator; onboard/install.cmake adds touchdown::models.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Programs write <touchdown/estimator.hpp> or <touchdown/estimator/…>, the headers among themselves
# "estimator/…".
set(public
  assembly/record assembly/signal_assembler
  contact_estimator free_fall labelled_run signal_guard signals torque_channel upkie_observer
  bayes/config bayes/filter bayes/measurement_fit bayes/measurement_model bayes/measurement_only
  bayes/transition_model c_interface/handle
  decision/config decision/descent decision/disturbance decision/draws decision/filter decision/fit
  decision/network decision/training
  evidence/curves evidence/filter evidence/fit evidence/touchdown evidence/touchdown_fit
  evidence/training
  force/force_kinematics force/force_kinematics_fit force/leg_geometry force/load_logistic
  force/load_logistic_fit force/logistic_regression force/support_force
  models/arrays models/compiled models/make_estimator models/passport
  neural/estimator neural/input neural/network
  phase/config phase/filter phase/fit phase/labels phase/model phase/phase)
# What these hold by value. Not for programs, and not promised to stay.
set(detail
  decision/channels decision/logit_decision decision/repetition decision/senses force/axle_motion
  force/wheel_loads neural/forward numerics/axis numerics/exponential numerics/noise_estimate
  phase/recursion phase/senses phase/tables spectrum/sliding_dft spectrum/summary)
set(include_dir ${CMAKE_INSTALL_INCLUDEDIR}/touchdown)
target_include_directories(touchdown_estimator PUBLIC
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
  $<INSTALL_INTERFACE:${include_dir}>
  $<INSTALL_INTERFACE:${include_dir}/detail>)
set_target_properties(touchdown_estimator PROPERTIES EXPORT_NAME estimator)

install(TARGETS touchdown_estimator EXPORT touchdownTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES estimator.hpp c_interface/touchdown.h DESTINATION ${include_dir})
install(FILES c_interface/touchdown.h DESTINATION ${include_dir}/estimator/c_interface)
foreach(header ${public})
  cmake_path(GET header PARENT_PATH room)
  install(FILES ${header}.hpp DESTINATION ${include_dir}/estimator/${room})
endforeach()
foreach(header ${detail})
  cmake_path(GET header PARENT_PATH room)
  install(FILES ${header}.hpp DESTINATION ${include_dir}/detail/estimator/${room})
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
