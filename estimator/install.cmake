# `cmake --install` of the estimator: the one part of touchdown that goes to a robot. Afterwards
# find_package(touchdown) gives touchdown::estimator.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Programs write <touchdown/estimator/…>, the headers among themselves "estimator/…".
target_include_directories(touchdown_estimator PUBLIC
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/touchdown>)
set_target_properties(touchdown_estimator PROPERTIES EXPORT_NAME estimator)

install(TARGETS touchdown_estimator EXPORT touchdownTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/touchdown/estimator
        FILES_MATCHING PATTERN "*.hpp")
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/../core/error.hpp
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/touchdown/core)

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
