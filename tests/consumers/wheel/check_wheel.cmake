# See CMakeLists.txt beside this file.
include(${CMAKE_CURRENT_LIST_DIR}/../../support/run.cmake)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
set(site ${WORK}/site)
set(ENV{PYTHONDONTWRITEBYTECODE} 1)
set(ENV{PIP_DISABLE_PIP_VERSION_CHECK} 1)
set(ENV{PIP_ROOT_USER_ACTION} ignore)
set(ENV{SIMDBEZIER_WHEEL_BUILD} ${BUILD})
unset(ENV{LD_LIBRARY_PATH})
unset(ENV{PYTHONPATH})

# A folder that is no build of the module for this Python is refused.
file(WRITE ${WORK}/foreign/CMakeCache.txt "")
execute_process(COMMAND ${CMAKE_COMMAND} -E env SIMDBEZIER_WHEEL_BUILD=${WORK}/foreign ${PYTHON} -m
                        pip wheel --no-index --no-deps --no-cache-dir -w ${WORK}/none ${SOURCE}
                RESULT_VARIABLE result OUTPUT_QUIET ERROR_QUIET)
if(result EQUAL 0)
  message(FATAL_ERROR "an empty build folder gave a wheel")
endif()

run(${PYTHON} -m pip wheel --no-index --no-deps --no-cache-dir -w ${WORK} ${SOURCE})
file(GLOB wheel ${WORK}/simdbezier-${VERSION}-*.whl)
run(${PYTHON} -m pip install --no-index --no-deps --target ${site} ${wheel})
set(ENV{PYTHONPATH} ${site})
run(${PYTHON} -m pip show simdbezier)
if(NOT output MATCHES "Version: ${VERSION}\n")
  message(FATAL_ERROR "pip knows: ${output}")
endif()

# What is loaded comes from the wheel, the library included, where it is not part of the module.
run(${PYTHON} -c "import simdbezier
print(simdbezier.__version__, simdbezier.__file__)
print([line.split()[-1] for line in open('/proc/self/maps') if 'simdbezier' in line])")
string(REPLACE "${site}/" "" elsewhere "${output}")
if(NOT output MATCHES "^${VERSION} ${site}/" OR elsewhere MATCHES "'/")
  message(FATAL_ERROR "expected everything below ${site}, found ${output}")
endif()
run(${PYTHON} ${SOURCE}/tests/python/run_page.py ${SOURCE}/docs/guide/python.md
    WORKING_DIRECTORY ${WORK})
