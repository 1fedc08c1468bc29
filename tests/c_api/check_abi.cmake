# Compares the C functions that the library exports, and the sizes of the structs that they take, with
# the committed list.
include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)

set(dynamic "")
if(LIBRARY MATCHES "[.]so")
  set(dynamic -D)
endif()
run(${NM} ${dynamic} --defined-only ${LIBRARY})
string(REGEX MATCHALL "[0-9a-f]+ [TW] simdbezier_[a-z0-9_]+" symbols "${output}")
list(TRANSFORM symbols REPLACE "^[0-9a-f]+ . " "")
list(SORT symbols)
list(REMOVE_DUPLICATES symbols)
run(${STRUCTS})
list(JOIN symbols "\n" found)
string(APPEND found "\n${output}")

if(DEFINED ENV{SIMDBEZIER_UPDATE_ABI})
  file(WRITE ${ABI} "${found}")
endif()
file(READ ${ABI} expected)
if(NOT found STREQUAL expected)
  file(WRITE abi.found "${found}")
  execute_process(COMMAND diff -u ${ABI} abi.found)
  message(FATAL_ERROR "The C ABI is not that of ${ABI}. Programs that are compiled already rely on it: "
                      "a struct may grow at its end, and a function may be added. Where that is what "
                      "changed, run this test with SIMDBEZIER_UPDATE_ABI=1 and commit the list.")
endif()
