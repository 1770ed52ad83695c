# `cpack` in the build folder makes packages for Debian 12, one of each component of RehearseInstall.cmake; scripts/packages
# builds what they hold first. docs/install.md says what is in them.
find_program(REHEARSE_DPKG dpkg-deb)
if(NOT PROJECT_IS_TOP_LEVEL OR NOT REHEARSE_DPKG)
  return()
endif()
set(maintainer "The Rehearse authors <rehearse@authors.invalid>")
set(package_of_program rehearse)
set(package_of_development librehearse-dev)
set(package_of_python python3-rehearse)
set(package_of_documentation rehearse-doc)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT ${maintainer})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program development documentation)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "rehearse-doc, python3-rehearse, librehearse-dev")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "learn a robot's policy in a handful of trials
Rehearse starts from a guess of the robot's dynamics: any simulator, a black
box with a few tunable parameters. It optimises a policy on the guess, tries
it once on the robot, corrects the guess from what happened, and repeats.
.
This package has the program rehearse, the page of its reports, and robots
and campaigns to try.")

# RehearseDependencies.cmake looks for all of these.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(development_depends libeigen3-dev libhwy-dev libtbb-dev libnlopt-dev libboost-dev libcli11-dev libtomlplusplus-dev
  nlohmann-json3-dev libfmt-dev librandom123-dev libmuparser-dev pkgconf)
if(TARGET rehearse_mpi)
  list(APPEND development_depends libopenmpi-dev)
endif()
if(MUJOCO_LIBRARY)
  list(APPEND development_depends libmujoco-dev)
endif()
if(DART_LIBRARY)
  list(APPEND development_depends libdart-dev)
endif()
list(JOIN development_depends ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "rehearse (= ${PROJECT_VERSION}), g++, cmake (>= 3.25)")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "learn a robot's policy in a handful of trials - libraries of C++
Rehearse starts from a guess of the robot's dynamics, tries a policy once on
the robot, corrects the guess from what happened, and repeats.
.
This package has static libraries, headers and a package for CMake: for robots
and learners of one's own in C++, and for the pieces alone.")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "learn a robot's policy in a handful of trials - documents
Rehearse starts from a guess of the robot's dynamics, tries a policy once on
the robot, corrects the guess from what happened, and repeats.
.
This package has the documents, what was measured, and examples of C++ and
Python.")

if(TARGET rehearse_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  get_directory_property(minor DIRECTORY python DEFINITION Python_VERSION_MINOR)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "rehearse (= ${PROJECT_VERSION}), python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/packaging/python/postinst ${PROJECT_SOURCE_DIR}/packaging/python/prerm)
 set(CPACK_COMPONENT_PYTHON_DESCRIPTION "learn a robot's policy in a handful of trials - module of Python 3
Rehearse starts from a guess of the robot's dynamics, tries a policy once on
the robot, corrects the guess from what happened, and repeats.
.
This package has the module rehearse: a robot is an object, with functions of
NumPy, formulas, or an environment of Gymnasium.")
endif()

# All that is in them, but for tests and benchmarks.
get_property(rooms GLOBAL PROPERTY REHEARSE_ROOMS)
list(TRANSFORM rooms REPLACE "/" "_")
list(TRANSFORM rooms PREPEND rehearse_)
add_custom_target(rehearse_packaged)
add_dependencies(rehearse_packaged ${rooms} rehearse_cli rehearse_reference_pages page)
if(TARGET rehearse_python)
  add_dependencies(rehearse_packaged rehearse_python_package)
endif()

# Files of every Debian package: copyright and changelog.
execute_process(COMMAND date --utc --rfc-email --date=${REHEARSE_RELEASE_DATE} OUTPUT_VARIABLE rfc_date
  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(changelog ${PROJECT_BINARY_DIR}/packages/changelog)
file(CONFIGURE OUTPUT ${changelog} @ONLY CONTENT "rehearse (@PROJECT_VERSION@) bookworm; urgency=medium

  * All changes: CHANGELOG.md of the package rehearse-doc.

 -- @maintainer@  @rfc_date@
")
execute_process(COMMAND gzip -9nkf ${changelog} COMMAND_ERROR_IS_FATAL ANY)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package_of_${component}})
  install(FILES packaging/copyright ${changelog}.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package_of_${component}}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
include(CPack)
