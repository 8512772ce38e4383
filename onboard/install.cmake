# `cmake --install` of touchdown::models, which reads model files. It has its own export, so that the
# estimator alone needs nothing but Eigen.
set(include_dir ${CMAKE_INSTALL_INCLUDEDIR}/touchdown)
set_target_properties(touchdown_onboard PROPERTIES EXPORT_NAME models OUTPUT_NAME touchdown_models)
set_target_properties(touchdown_onboard PROPERTIES ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
target_include_directories(touchdown_onboard PUBLIC
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
  $<INSTALL_INTERFACE:${include_dir}>)
install(TARGETS touchdown_onboard EXPORT touchdownModelsTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES load_estimator.hpp DESTINATION ${include_dir})
install(EXPORT touchdownModelsTargets NAMESPACE touchdown::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/touchdown)
