set(REHEARSE_WARNINGS -Wall -Wextra -Wpedantic -Wno-missing-field-initializers)
# -O1: what is measured is in the libraries, and Eigen at -O3 takes the compiler minutes.
set(REHEARSE_TEST_OPTIONS $<$<CONFIG:Release>:-O1> ${REHEARSE_WARNINGS})

# Headers that nearly every test reads are parsed once. The target has no definitions of its own, since a compiler refuses
# precompiled headers that others might have read otherwise. Not so of sources: at -O3 GCC 12 then warns of what is in
# the standard library. A program, though of no test, since programs and libraries are compiled differently.
if(REHEARSE_TESTS)
  set(empty ${PROJECT_BINARY_DIR}/empty.cpp)
  file(CONFIGURE OUTPUT ${empty} CONTENT "")
  add_executable(rehearse_test_headers ${empty})
  target_link_libraries(rehearse_test_headers PRIVATE Eigen3::Eigen GTest::gtest GTest::gtest_main)
  target_compile_options(rehearse_test_headers PRIVATE ${REHEARSE_TEST_OPTIONS})
  target_precompile_headers(rehearse_test_headers PRIVATE <Eigen/Core> <gtest/gtest.h>)
endif()

option(REHEARSE_TOGETHER "Compile several sources at once; OFF for tools that look at one by one (scripts/lint)" ON)

# Compiles the sources of a target at once: what takes the compiler long in them are headers and templates, which they
# share. The largest takes 2.2 GB. Names of helpers are unique in the target.
function(rehearse_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${REHEARSE_TOGETHER} UNITY_BUILD_BATCH_SIZE 0)
endfunction()

# The same, and optimises them little.
function(rehearse_cold target)
  rehearse_together(${target})
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# rehearse_room(NAME [SOURCES file...] [ALONE file...] [USES room...] [FOLDERS folder...] [LINKS target...] [PRIVATE_LINKS target...] [TEST_USES room...]
#               [TEST_LINKS target...] [COLD])
#
# Makes the folder it is called from a room: one static library rehearse_NAME (rehearse::NAME when installed) of its
# *.cpp, those of FOLDERS included, and one test program of its test/*.cpp; with SOURCES of those alone, and no test. USES is the room's row in the table of
# docs/architecture.md, ALONE what is not compiled together with others, TEST_USES what its tests use beside that: a file that includes a header of another room is an
# error at configure time, so the build enforces the direction; so is a room of which nothing is included. COLD: nothing in
# it takes long, so compiling it must not either (rehearse_cold).
function(rehearse_room name)
  cmake_parse_arguments(ROOM "COLD" "" "SOURCES;ALONE;USES;FOLDERS;LINKS;PRIVATE_LINKS;TEST_USES;TEST_LINKS" ${ARGN})
  string(REPLACE "/" "_" target ${name})

  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  if(ROOM_SOURCES)
    set(sources ${ROOM_SOURCES})
    list(TRANSFORM sources PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  endif()
  file(GLOB headers CONFIGURE_DEPENDS *.hpp *.h)
  foreach(folder IN LISTS ROOM_FOLDERS)
    file(GLOB more_sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    file(GLOB more_headers CONFIGURE_DEPENDS ${folder}/*.hpp)
    list(APPEND sources ${more_sources})
    list(APPEND all_headers ${more_headers})
    install(FILES ${more_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rehearse/${name}/${folder})
  endforeach()
  list(APPEND all_headers ${headers})
  rehearse_check_includes("${name}" "${ROOM_USES}" "${ROOM_USES}" "${sources};${all_headers}")

  list(TRANSFORM ROOM_USES REPLACE "/" "_" OUTPUT_VARIABLE uses)
  list(TRANSFORM uses PREPEND rehearse_)
  if(sources)
    add_library(rehearse_${target} STATIC ${sources})
    # Multiply-adds are fused where the source says so and nowhere else, so that every instruction set rounds alike.
    target_compile_options(rehearse_${target} PRIVATE ${REHEARSE_WARNINGS} -ffp-contract=off)
    target_link_libraries(rehearse_${target} PUBLIC ${uses} ${ROOM_LINKS} PRIVATE ${ROOM_PRIVATE_LINKS})
    rehearse_together(rehearse_${target})
    foreach(source IN LISTS sources)  # a kernel includes itself once for each instruction set
      file(STRINGS ${source} kernel REGEX "HWY_TARGET_INCLUDE|REHEARSE_EQUATION" LIMIT_COUNT 1)
      if(kernel)
        list(APPEND ROOM_ALONE ${source})
      endif()
    endforeach()
    set_source_files_properties(${ROOM_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    if(ROOM_COLD)
      rehearse_cold(rehearse_${target})
    endif()
    set(scope PUBLIC)
  else()
    add_library(rehearse_${target} INTERFACE)
    target_link_libraries(rehearse_${target} INTERFACE ${uses} ${ROOM_LINKS})
    set(scope INTERFACE)
  endif()
  add_library(rehearse::${target} ALIAS rehearse_${target})
  set_target_properties(rehearse_${target} PROPERTIES EXPORT_NAME ${target})
  target_include_directories(rehearse_${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(rehearse_${target} ${scope} cxx_std_20)

  install(TARGETS rehearse_${target} EXPORT rehearse-targets)
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rehearse/${name})
  set_property(GLOBAL APPEND PROPERTY REHEARSE_ROOMS ${name})

  file(GLOB tests CONFIGURE_DEPENDS test/*.cpp)
  file(GLOB test_headers CONFIGURE_DEPENDS test/*.hpp)
  rehearse_check_includes("${name}" "${ROOM_USES};${ROOM_TEST_USES}" "${ROOM_TEST_USES}" "${tests};${test_headers}")
  if(REHEARSE_TESTS AND tests AND NOT ROOM_SOURCES)
    add_executable(test_${target} ${tests})
    rehearse_together(test_${target})
    target_compile_options(test_${target} PRIVATE ${REHEARSE_TEST_OPTIONS})
    target_precompile_headers(test_${target} REUSE_FROM rehearse_test_headers)
    target_compile_definitions(test_${target} PRIVATE TEST_DATA_DIR="${CMAKE_CURRENT_SOURCE_DIR}/test/data")
    list(TRANSFORM ROOM_TEST_USES REPLACE "/" "_" OUTPUT_VARIABLE test_uses)
    list(TRANSFORM test_uses PREPEND rehearse_)
    target_link_libraries(test_${target} PRIVATE rehearse_${target} ${test_uses} ${ROOM_TEST_LINKS} GTest::gtest GTest::gtest_main)
    gtest_discover_tests(test_${target} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60)
  endif()
endfunction()

# The room of a path below src/rehearse ("learners/pilco/model.hpp"): the innermost folder that calls itself one.
function(rehearse_room_of path result)
  set(rooms_folder ${PROJECT_SOURCE_DIR}/src/rehearse)
  get_filename_component(folder ${path} DIRECTORY)
  while(folder AND NOT EXISTS ${rooms_folder}/${folder}/CMakeLists.txt)
    get_filename_component(folder "${folder}" DIRECTORY)
  endwhile()
  set(${result} "${folder}" PARENT_SCOPE)
endfunction()

# Stops unless these files include headers of the room `name` and of `allowed` rooms alone, and some of each of `needed`.
function(rehearse_check_includes name allowed needed files)
  foreach(file IN LISTS files)
    if(NOT file)
      continue()
    endif()
    file(STRINGS ${file} includes REGEX "#include [\"<]rehearse/")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE ".*[\"<]rehearse/([^\">]*)[\">].*" "\\1" header "${line}")
      rehearse_room_of(${header} other)
      list(REMOVE_ITEM needed "${other}")
      if(NOT other STREQUAL name AND NOT other IN_LIST allowed)
        message(FATAL_ERROR "${file} includes a header of room '${other}', which room '${name}' may not use:\n  ${line}\n"
                            "Rooms and their direction: docs/architecture.md")
      endif()
    endforeach()
  endforeach()
  if(needed)
    message(FATAL_ERROR "Room '${name}' says that it uses '${needed}', of which its files include nothing.\n"
                        "Rooms and their direction: docs/architecture.md")
  endif()
endfunction()
