# simdbezier_add_tests(PROGRAM PREFIX SOURCES file… [LIBRARIES target…])
#
# Adds a GoogleTest program, and one ctest test for each of its suites, named PREFIX + suite.
#
# A test for each case, as gtest_discover_tests() makes them, would take four times as long: suites
# prepare their patches and the oracle's answers once for all of their cases and instruction sets.
function(simdbezier_add_tests program prefix)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "SOURCES;LIBRARIES")
  add_executable(${program} ${arg_SOURCES})
  target_link_libraries(${program} PRIVATE simdbezier_test_support simdbezier_private_flags
                                           simdbezier_oracle ${arg_LIBRARIES} GTest::gtest_main)
  set_target_properties(${program} PROPERTIES UNITY_BUILD ON
                                              UNITY_BUILD_BATCH_SIZE ${SIMDBEZIER_TEST_BATCH})
  # Precompiled headers demand the same flags.
  if(TARGET simdbezier_test_headers AND "simdbezier::simdbezier" IN_LIST arg_LIBRARIES
     AND NOT "OpenMP::OpenMP_CXX" IN_LIST arg_LIBRARIES)
    target_precompile_headers(${program} REUSE_FROM simdbezier_test_headers)
  endif()
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${program}_suites.cmake)
  file(GENERATE OUTPUT ${list}
       CONTENT "set(program \"$<TARGET_FILE:${program}>\")
set(emulator \"${CMAKE_CROSSCOMPILING_EMULATOR}\")
set(prefix \"${prefix}\")
set(label \"${SIMDBEZIER_TEST_LABEL}\")
include(\"${PROJECT_SOURCE_DIR}/tests/support/list_suites.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${list})
endfunction()

# Sets RESULT to whether the Python that the module is built for can import all MODULES. Where it
# cannot, a message says that WHAT is not tested.
function(simdbezier_can_import result what)
  list(JOIN ARGN ", " modules)
  execute_process(COMMAND ${SIMDBEZIER_MODULE_PYTHON} -c "import ${modules}"
                  RESULT_VARIABLE missing OUTPUT_QUIET ERROR_QUIET)
  if(missing)
    message(STATUS "one of ${modules} is absent: ${what} is not tested")
    set(${result} FALSE PARENT_SCOPE)
  else()
    set(${result} TRUE PARENT_SCOPE)
  endif()
endfunction()

# Gives the folder's label to its tests that are no GoogleTest suites. It is called at the end of
# the folder's CMakeLists.txt.
function(simdbezier_label_tests)
  get_property(tests DIRECTORY PROPERTY TESTS)
  if(tests)
    set_tests_properties(${tests} PROPERTIES LABELS "${SIMDBEZIER_TEST_LABEL}")
  endif()
endfunction()
