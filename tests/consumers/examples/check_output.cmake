# Runs PROGRAM, which must succeed and print exactly what EXPECTED holds.
include(${CMAKE_CURRENT_LIST_DIR}/../../support/run.cmake)
run(${PROGRAM})
file(READ ${EXPECTED} expected)
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "${PROGRAM} printed\n${output}instead of\n${expected}")
endif()
