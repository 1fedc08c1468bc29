# Read by ctest, with `program`, `prefix` and `label` set (add_tests.cmake): asks the program.
if(NOT EXISTS ${program})
  get_filename_component(name ${program} NAME)
  add_test(${name}_NOT_BUILT ${program})
  return()
endif()
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE listing
                RESULT_VARIABLE result ERROR_VARIABLE errors)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${program} --gtest_list_tests: ${result}\n${errors}")
endif()
# Suites end in a dot, and their cases are indented below them; "#" begins a type or a parameter.
string(REGEX MATCHALL "(^|\n)[^ \n.]+\\." suites "${listing}")
if(NOT suites)
  message(FATAL_ERROR "${program} has no tests")
endif()
# Tests run side by side: threads that spin while they wait would take the cores from the others.
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n|\\.$" "" suite "${suite}")
  add_test("${prefix}${suite}" ${program} "--gtest_filter=${suite}.*")
  set_tests_properties("${prefix}${suite}" PROPERTIES ENVIRONMENT OMP_WAIT_POLICY=passive
                                                     LABELS "${label}")
endforeach()
