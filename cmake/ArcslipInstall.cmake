# The installed package: find_package(arcslip) gives arcslip::control, arcslip::continuation, arcslip::structures, arcslip::optimize.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/arcslip)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/arcslipConfig.cmake.in
  ${PROJECT_BINARY_DIR}/arcslipConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/arcslipConfigVersion.cmake
  VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/arcslipConfig.cmake ${PROJECT_BINARY_DIR}/arcslipConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindSuiteSparse.cmake
        DESTINATION ${package_folder})
install(EXPORT arcslip NAMESPACE arcslip:: FILE arcslipTargets.cmake DESTINATION ${package_folder})
install(CODE "set(BUILD \"${PROJECT_BINARY_DIR}\")
set(PLACE \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")
include(\"${PROJECT_SOURCE_DIR}/cmake/install_headers.cmake\")")
