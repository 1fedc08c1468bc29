# See CMakeLists.txt beside this file.
set(prefix ${WORK}/prefix)
file(REMOVE_RECURSE ${prefix} ${WORK}/consumer ${WORK}/c_consumer)

include(${CMAKE_CURRENT_LIST_DIR}/../../support/run.cmake)

function(expect_no_leak what text)
  foreach(word IN ITEMS xsimd fopenmp omp mavx msse mfma ffp-contract)
    if(text MATCHES "${word}")
      message(FATAL_ERROR "${what} mentions ${word}:\n${text}")
    endif()
  endforeach()
endfunction()

function(expect_teapot_point text)
  if(NOT text MATCHES "corner 0 0 0")
    message(FATAL_ERROR "the consumer printed: ${text}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} --config ${CONFIG})

# A consumer finds the library by CMake.
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/consumer -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX}
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_EXE_LINKER_FLAGS=${LINK_FLAGS}
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
run(${WORK}/consumer/consumer)
expect_teapot_point("${output}")
file(READ ${WORK}/consumer/compile_commands.json commands)
string(REGEX MATCHALL "\"command\": [^\n]*" commands "${commands}")
string(REPLACE "${prefix}" "" commands "${commands}")
expect_no_leak("the consumer's compile command" "${commands}")

# A consumer finds it by pkg-config.
find_program(pkg_config pkg-config)
if(NOT pkg_config)
  message(FATAL_ERROR "pkg-config is needed for this test")
endif()
set(ENV{PKG_CONFIG_PATH} ${prefix}/${LIBDIR}/pkgconfig)
run(${pkg_config} --cflags --libs simdbezier)
expect_no_leak("pkg-config" "${output}")
separate_arguments(flags UNIX_COMMAND "${output}")
run(${CXX} -std=c++20 ${SOURCE}/main.cpp -o ${WORK}/by_pkg_config ${flags} ${LINK_FLAGS}
    -Wl,-rpath,${prefix}/${LIBDIR})
run(${WORK}/by_pkg_config)
expect_teapot_point("${output}")

# C finds it by CMake, in a project that has no other language, and by pkg-config.
run(${CMAKE_COMMAND} -S ${SOURCE}/../c_consumer -B ${WORK}/c_consumer -G ${GENERATOR}
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_EXE_LINKER_FLAGS=${LINK_FLAGS})
run(${CMAKE_COMMAND} --build ${WORK}/c_consumer)
run(${WORK}/c_consumer/c_consumer)
expect_teapot_point("${output}")
run(${CC} -std=c99 -Wall -Wextra -Wpedantic -Werror ${SOURCE}/../c_consumer/main.c
    -o ${WORK}/c_by_pkg_config ${flags} ${LINK_FLAGS} -Wl,-rpath,${prefix}/${LIBDIR})
run(${WORK}/c_by_pkg_config)
expect_teapot_point("${output}")

# An older standard is named as what is wrong.
execute_process(COMMAND ${CXX} -std=c++17 -fsyntax-only ${SOURCE}/main.cpp ${flags}
                RESULT_VARIABLE result ERROR_VARIABLE errors OUTPUT_QUIET)
if(result EQUAL 0 OR NOT errors MATCHES "need C\\+\\+20")
  message(FATAL_ERROR "C++17: expected the headers to ask for C++20, found ${result}: ${errors}")
endif()

# Python finds it where the module was built.
if(PYTHON)
  set(ENV{PYTHONPATH} ${prefix}/lib/python3/dist-packages)
  run(${PYTHON} -B -c "import simdbezier, numpy
grid = numpy.stack(numpy.meshgrid(range(4), range(4), [0]), -1).reshape(1, 4, 4, 3)
corner = simdbezier.PatchSet(grid, dtype='float32').evaluate_grid(9, 9)['position'][0, 0, 0]
assert '${prefix}' in simdbezier.__file__
print('corner', *corner.astype(int))")
  expect_teapot_point("${output}")
endif()

# The installed programs find the installed library; they are all that is installed to be run.
file(GLOB programs RELATIVE ${prefix}/bin ${prefix}/bin/*)
foreach(program IN LISTS programs)
  if(NOT program MATCHES "^simdbezier(_accuracy|-mpi)?$")
    message(FATAL_ERROR "bin/${program} was installed")
  endif()
  run(${prefix}/bin/${program} --help)
endforeach()
