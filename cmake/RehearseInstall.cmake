# `cmake --install` puts everything where it belongs, in four components, which are the packages of RehearsePackages.cmake:
#   program        the program, its page, schema, manual pages, completions, and robots to try
#   development    libraries and headers, as their rooms say, and a package that find_package(rehearse) finds
#   python         the module, where Debian's Python looks; only where it is asked for by name
#   documentation  the documents and the examples of C++ and Python
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

set(shown ${CMAKE_INSTALL_DATADIR}/doc/rehearse)
set(reference ${PROJECT_BINARY_DIR}/reference)
install(TARGETS rehearse_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/share/rehearse/report.html DESTINATION ${CMAKE_INSTALL_DATADIR}/rehearse
  COMPONENT program OPTIONAL)
install(DIRECTORY schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/rehearse COMPONENT program)
install(DIRECTORY ${reference}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program FILES_MATCHING PATTERN "*.gz")
install(FILES ${reference}/bash/rehearse DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${reference}/zsh/_rehearse DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${reference}/fish/rehearse.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
  COMPONENT program)
install(DIRECTORY examples/robots examples/models examples/programs campaigns presets DESTINATION ${shown}/examples
  COMPONENT program FILES_MATCHING PATTERN "*.toml" PATTERN "*.xml" PATTERN "*.py" PATTERN "*.c" PATTERN "*.js" PATTERN "*.sh"
  PATTERN "__pycache__" EXCLUDE)

install(FILES README.md CHANGELOG.md CONTRIBUTING.md DESTINATION ${shown} COMPONENT documentation)
install(DIRECTORY docs DESTINATION ${shown} COMPONENT documentation
  FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png")
install(DIRECTORY examples/own_robot examples/own_learner examples/python examples/contest examples/same_robot
  DESTINATION ${shown}/examples COMPONENT documentation FILES_MATCHING PATTERN "*.?pp" PATTERN "*.[ch]" PATTERN "*.py"
  PATTERN "*.toml" PATTERN "*.xml" PATTERN "CMakeLists.txt" PATTERN "__pycache__" EXCLUDE)
install(PROGRAMS examples/contest/score DESTINATION ${shown}/examples/contest COMPONENT documentation)

if(TARGET rehearse_python)
  set(module_folder lib/python3/dist-packages/rehearse)
  file(GLOB modules CONFIGURE_DEPENDS python/rehearse/*.py python/rehearse/*.pyi python/rehearse/py.typed)
  install(TARGETS rehearse_python LIBRARY DESTINATION ${module_folder} COMPONENT python EXCLUDE_FROM_ALL)
  install(FILES ${modules} DESTINATION ${module_folder} COMPONENT python EXCLUDE_FROM_ALL)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/python/METADATA CONTENT
    "Metadata-Version: 2.1\nName: rehearse\nVersion: @PROJECT_VERSION@\nSummary: @PROJECT_DESCRIPTION@\nRequires-Dist: numpy\n"
    @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/python/METADATA COMPONENT python EXCLUDE_FROM_ALL
    DESTINATION lib/python3/dist-packages/rehearse-${PROJECT_VERSION}.dist-info)
endif()
