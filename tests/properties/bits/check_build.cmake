# See CMakeLists.txt beside this file. OTHER is gcc, clang or aarch64.
#
# The library is built at -O1, with the widest instruction set that this machine has, and with the
# scalar one, whose bits are those of all sets without FMA. Where SIMDBEZIER_LONG_TESTS is in the
# environment, as in ./run accuracy, it is a Release build of all kernels, which takes more than twice
# as long to compile. What differs between compilers and machines (contraction, order of evaluation,
# instructions that stand for one another) shows at any level and in any width; what only shows at
# -O3 are faults of the other optimiser.
include(${CMAKE_CURRENT_LIST_DIR}/../../support/run.cmake)
set(configure -DBUILD_SHARED_LIBS=OFF -DSIMDBEZIER_BUILD_TOOLS=OFF -DSIMDBEZIER_BUILD_BENCH=OFF
              -DSIMDBEZIER_BUILD_EXAMPLES=OFF -DSIMDBEZIER_WERROR=ON)
if(DEFINED ENV{SIMDBEZIER_LONG_TESTS})
  list(APPEND configure -DCMAKE_BUILD_TYPE=Release)
else() # a Debug build has its kernels at -O1; a few large sources compile faster than many
  list(APPEND configure -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -DNDEBUG"
       -DCMAKE_UNITY_BUILD=ON)
  run(${HASH} --widest)
  set(ISAS ${output} scalar) # whose masks are bools: compilers warn about what registers need
  list(REMOVE_DUPLICATES ISAS)
endif()
set(emulator)
set(link)
if(NOT OTHER STREQUAL "aarch64")
  # A list as an argument would become several of them.
  file(WRITE ${WORK}/isas.cmake "set(SIMDBEZIER_ISAS \"${ISAS}\" CACHE STRING \"\" FORCE)\n")
  list(APPEND configure -C ${WORK}/isas.cmake)
endif()
set(compiler_of_gcc g++)
set(compiler_of_clang clang++)
set(compiler_of_aarch64 aarch64-linux-gnu-g++)
find_program(compiler ${compiler_of_${OTHER}})
if(NOT compiler)
  message("skipped: ${compiler_of_${OTHER}} is not installed")
  return()
endif()
if(OTHER STREQUAL "aarch64")
  find_program(emulator_program qemu-aarch64)
  if(NOT emulator_program)
    message("skipped: qemu-aarch64 is not installed")
    return()
  endif()
  set(emulator ${emulator_program})
  # The cross compiler's loader and the libraries of the architecture arm64, where both are
  # installed, are of different versions, and a program that mixes them never begins.
  set(link -static)
  # Only xsimd may come from the host's include folder, whose other headers are the host's own.
  file(COPY ${XSIMD_INCLUDE_DIR}/xsimd DESTINATION ${WORK}/include)
  list(APPEND configure -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64
       -DSIMDBEZIER_XSIMD_INCLUDE_DIR=${WORK}/include)
endif()

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja -DCMAKE_CXX_COMPILER=${compiler}
    ${configure})
run(${CMAKE_COMMAND} --build ${WORK}/build --target simdbezier --parallel ${JOBS})
run(${compiler} -std=c++20 -O1 -ffp-contract=off -DSIMDBEZIER_STATIC
    -DSIMDBEZIER_SHARED_DATA="" -I${SOURCE} -I${SOURCE}/include
    ${SOURCE}/tests/properties/bits/determinism_hash.cpp ${WORK}/build/libsimdbezier.a ${link} -fopenmp
    -o ${WORK}/determinism_hash)
run(${emulator} ${WORK}/determinism_hash)
set(there "${output}")
run(${HASH})
if(there STREQUAL "")
  message(FATAL_ERROR "no hashes were printed")
endif()
# A build of few instruction sets has one class of results only.
foreach(class fma nofma)
  if(NOT output MATCHES "(^|\n)${class} ")
    string(REGEX REPLACE "(^|\n)${class} [^\n]*" "" there "${there}")
  endif()
endforeach()
string(STRIP "${there}" there)
string(STRIP "${output}" output)
if(NOT there STREQUAL output)
  message(FATAL_ERROR "bits differ.\nThis build:\n${output}\n${OTHER}:\n${there}")
endif()
message("equal bits:\n${there}")
