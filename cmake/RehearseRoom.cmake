# rehearse_room(NAME [USES room...] [LINKS target...] [PRIVATE_LINKS target...])
#
# Makes the folder it is called from a room: one static library rehearse_NAME (rehearse::NAME when installed) of its
# *.cpp, and one test program of its test/*.cpp. USES is the room's row in the table of docs/architecture.md: a
# source that includes a header of another room is an error at configure time, so the build enforces the direction.
function(rehearse_room name)
  cmake_parse_arguments(ROOM "" "" "USES;LINKS;PRIVATE_LINKS;TEST_LINKS" ${ARGN})
  string(REPLACE "/" "_" target ${name})
  string(REGEX REPLACE "/.*" "" top ${name})

  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  file(GLOB headers CONFIGURE_DEPENDS *.hpp *.h)
  rehearse_check_includes(${name} ${top} "${ROOM_USES}" "${sources};${headers}")

  list(TRANSFORM ROOM_USES REPLACE "/" "_" OUTPUT_VARIABLE uses)
  list(TRANSFORM uses PREPEND rehearse_)
  if(sources)
    add_library(rehearse_${target} STATIC ${sources})
    # Multiply-adds are fused where the source says so and nowhere else, so that every instruction set rounds alike.
    target_compile_options(rehearse_${target} PRIVATE -Wall -Wextra -Wpedantic -Wno-missing-field-initializers
      -ffp-contract=off)
    target_link_libraries(rehearse_${target} PUBLIC ${uses} ${ROOM_LINKS} PRIVATE ${ROOM_PRIVATE_LINKS})
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
  if(REHEARSE_TESTS AND tests)
    add_executable(test_${target} ${tests})
    # -O1: what is measured is in the libraries, and Eigen at -O3 takes the compiler minutes.
    target_compile_options(test_${target} PRIVATE $<$<CONFIG:Release>:-O1> -Wall -Wextra -Wpedantic -Wno-missing-field-initializers)
    target_compile_definitions(test_${target} PRIVATE TEST_DATA_DIR="${CMAKE_CURRENT_SOURCE_DIR}/test/data")
    list(TRANSFORM ROOM_TEST_LINKS PREPEND rehearse_)
    target_link_libraries(test_${target} PRIVATE rehearse_${target} ${ROOM_TEST_LINKS} GTest::gtest GTest::gtest_main)
    gtest_discover_tests(test_${target} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
  endif()
endfunction()

function(rehearse_check_includes name top uses files)
  foreach(file IN LISTS files)
    if(NOT file)
      continue()
    endif()
    file(STRINGS ${file} includes REGEX "#include [\"<]rehearse/")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE ".*rehearse/([a-z_]+)/.*" "\\1" other "${line}")
      if(NOT other STREQUAL top AND NOT other IN_LIST uses)
        message(FATAL_ERROR "${file} includes a header of room '${other}', which room '${name}' may not use:\n  ${line}\n"
                            "Rooms and their direction: docs/architecture.md")
      endif()
    endforeach()
  endforeach()
endfunction()
