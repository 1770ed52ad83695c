# `cmake --install` puts libraries, headers and a package that another project finds with find_package(rehearse).
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/rehearse)
install(EXPORT rehearse-targets NAMESPACE rehearse:: DESTINATION ${package_folder})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/rehearse-config.cmake.in
  ${PROJECT_BINARY_DIR}/rehearse-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rehearse-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/rehearse-config.cmake
  ${PROJECT_BINARY_DIR}/rehearse-config-version.cmake
  ${PROJECT_SOURCE_DIR}/cmake/RehearseDependencies.cmake
  DESTINATION ${package_folder})
