# See CMakeLists.txt beside this file: BUILD_TYPE and KIND are the parent's choices, empty for none.
include(${CMAKE_CURRENT_LIST_DIR}/../../support/run.cmake)

# The parent's own xsimd is a copy, whose path shows in the commands.
file(REMOVE_RECURSE ${WORK})
file(COPY ${XSIMD_INCLUDE_DIR}/xsimd DESTINATION ${WORK}/own_xsimd)
set(choice)
if(BUILD_TYPE)
  list(APPEND choice -DCMAKE_BUILD_TYPE=${BUILD_TYPE})
endif()
# The compiler's debug information and optimisation would take most of the time. Each source is
# compiled by itself, as users compile it: ./run test compiles several as one.
run(${CMAKE_COMMAND} -S ${PARENT} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX}
    ${choice} -DBUILD_TYPE=${BUILD_TYPE} -DKIND=${KIND} -DFETCH=${FETCH}
    -DSIMDBEZIER_SOURCE=${SOURCE} -DOWN_XSIMD=${WORK}/own_xsimd -DSIMDBEZIER_ISAS=scalar
    -DCMAKE_CXX_FLAGS_DEBUG= -DCMAKE_EXPORT_COMPILE_COMMANDS=ON)
file(READ ${WORK}/build/compile_commands.json commands)
string(FIND "${commands}" "${WORK}/own_xsimd" at)
if(at EQUAL -1)
  message(FATAL_ERROR "the parent's xsimd is not used:\n${commands}")
endif()

if(BUILD)
  run(${CMAKE_COMMAND} --build ${WORK}/build)
  run(${WORK}/build/consumer)
  if(NOT output MATCHES "corner 0 0 0")
    message(FATAL_ERROR "the consumer printed: ${output}")
  endif()
  # The parent's -ffast-math does not reach the library. These are the bits of sets without FMA.
  run(${WORK}/build/values)
  if(NOT output STREQUAL "bits 14a3dc01, NaN refused\n")
    message(FATAL_ERROR "beside -ffast-math, the library printed: ${output}")
  endif()
  # Instruction sets that were left out are refused.
  set(ENV{SIMDBEZIER_ISA} avx2)
  execute_process(COMMAND ${WORK}/build/consumer OUTPUT_VARIABLE output)
  if(NOT output MATCHES "not in this build")
    message(FATAL_ERROR "without AVX2, the consumer that asks for it printed: ${output}")
  endif()
endif()
