# One ctest test for each suite of a GoogleTest program, named PREFIX + suite.
#
# Not one for each case, as gtest_discover_tests() makes them: suites prepare their patches and the
# oracle's answers once for all of their cases and instruction sets, which a process for each case
# does anew: three quarters of their time.
#
#     simdbezier_discover_suites(test_curves curves.)
function(simdbezier_discover_suites target)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  file(GENERATE OUTPUT ${list}
       CONTENT "set(program \"$<TARGET_FILE:${target}>\")
set(prefix \"${ARGV1}\")
include(\"${PROJECT_SOURCE_DIR}/tests/list_suites.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${list})
endfunction()
