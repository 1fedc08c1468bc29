# See CMakeLists.txt beside this file.
set(bare)
foreach(package CLI11 nlohmann_json ZLIB benchmark GTest)
  list(APPEND bare -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()

# configure(NAME EXPECTED OPTION…): EXPECTED is a pattern of the error, or empty where there is
# none.
function(configure name expected)
  file(REMOVE_RECURSE ${WORK}/${name})
  execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/${name} -G ${GENERATOR}
            -DCMAKE_CXX_COMPILER=${CXX} -DSIMDBEZIER_XSIMD_INCLUDE_DIR=${XSIMD_INCLUDE_DIR} ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  string(REGEX REPLACE "[ \n]+" " " errors "${errors}") # CMake breaks lines where it likes
  if(expected STREQUAL "")
    if(NOT result EQUAL 0)
      message(FATAL_ERROR "${name}: ${errors}")
    endif()
  elseif(result EQUAL 0 OR NOT errors MATCHES "${expected}")
    message(FATAL_ERROR "${name}: expected ${expected}, found ${result}: ${errors}")
  endif()
endfunction()

# expect_targets(NAME FOUND TARGET…): whether the configured build has them.
function(expect_targets name found)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/${name} --target help
                  OUTPUT_VARIABLE targets)
  foreach(target IN LISTS ARGN)
    set(has OFF)
    if(targets MATCHES "(^|[\n ])${target}[: \n]")
      set(has ON)
    endif()
    if(NOT has STREQUAL found)
      message(FATAL_ERROR "${name}: is ${target} there: expected ${found}, found ${has}")
    endif()
  endforeach()
endfunction()

# expect_cached(NAME VARIABLE VALUE)
function(expect_cached name variable value)
  file(STRINGS ${WORK}/${name}/CMakeCache.txt line REGEX "^${variable}:")
  if(NOT line MATCHES "=${value}$")
    message(FATAL_ERROR "${name}: expected ${variable} to be ${value}, found '${line}'")
  endif()
endfunction()

# A compiler, CMake and xsimd are enough for the library, which is a shared one, and for speed.
configure(bare "" ${bare})
expect_targets(bare ON simdbezier install)
expect_targets(bare OFF simdbezier_cli simdbezier_io simdbezier_bench test_pack example_tiles)
expect_cached(bare BUILD_SHARED_LIBS ON)
expect_cached(bare CMAKE_BUILD_TYPE Release)

# Where the program's packages are there it is built as well, the rest only where it is asked for.
if(TOOLS_CAN_BE_BUILT)
  configure(plain "")
  expect_targets(plain ON simdbezier_cli)
  expect_targets(plain OFF simdbezier_bench test_pack example_tiles)
endif()

# What is asked for and cannot be had is an error that names it.
set(zlib -DCMAKE_DISABLE_FIND_PACKAGE_ZLIB=OFF) # readers, which all of these have
configure(no_zlib ZLIB ${bare} -DSIMDBEZIER_BUILD_TOOLS=ON)
configure(no_tools CLI11 ${bare} ${zlib} -DSIMDBEZIER_BUILD_TOOLS=ON)
configure(no_bench benchmark ${bare} ${zlib} -DSIMDBEZIER_BUILD_BENCH=ON)
configure(no_tests GTest ${bare} ${zlib} -DSIMDBEZIER_BUILD_TESTS=ON)

# Parts of the instruction sets can be asked for, and names that are none are refused.
configure(subset "" ${bare} -DSIMDBEZIER_ISAS=scalar)
file(READ ${WORK}/subset/compile_commands.json commands)
string(REGEX MATCHALL "SIMDBEZIER_ISA=[a-z0-9]+" isas "${commands}")
list(REMOVE_DUPLICATES isas)
if(NOT isas STREQUAL "SIMDBEZIER_ISA=scalar")
  message(FATAL_ERROR "subset: expected the scalar kernels, found '${isas}'")
endif()
configure(bad_isa "expected some of scalar, [a-z0-9, ]+, found 'avx3'" ${bare}
          -DSIMDBEZIER_ISAS=avx3)

# Threads other than OpenMP's can be asked for.
configure(std_threads "" ${bare} -DCMAKE_DISABLE_FIND_PACKAGE_OpenMP=ON)
expect_cached(std_threads SIMDBEZIER_THREADS std)
configure(no_threads "" ${bare} -DSIMDBEZIER_THREADS=none)
configure(bad_threads "expected openmp, std or none, found 'tbb'" ${bare} -DSIMDBEZIER_THREADS=tbb)
configure(no_install "" ${bare} -DSIMDBEZIER_INSTALL=OFF)
expect_targets(no_install OFF install)
