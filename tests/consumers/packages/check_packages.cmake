# See CMakeLists.txt beside this file.
include(${CMAKE_CURRENT_LIST_DIR}/../../support/run.cmake)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

get_filename_component(cmake_folder ${CMAKE_COMMAND} DIRECTORY)
find_program(cpack cpack HINTS ${cmake_folder} REQUIRED)
run(${cpack} -G DEB --config ${BUILD}/CPackConfig.cmake -B ${WORK}/packages)
file(GLOB packages ${WORK}/packages/*.deb)
foreach(name IN ITEMS libsimdbezier libsimdbezier-dev simdbezier-tools)
  if(NOT packages MATCHES "/${name}[0-9.]*_${VERSION}")
    message(FATAL_ERROR "no package ${name} among ${packages}")
  endif()
endforeach()

find_program(lintian lintian)
foreach(package IN LISTS packages)
  if(lintian)
    execute_process(COMMAND ${lintian} --fail-on error ${package} RESULT_VARIABLE result
                    OUTPUT_VARIABLE said ERROR_VARIABLE said)
    if(NOT result EQUAL 0)
      message(FATAL_ERROR "lintian, of ${package}:\n${said}")
    endif()
  endif()
  run(dpkg-deb -x ${package} ${WORK}/root)
endforeach()

# The root is not where the system looks for libraries, so the loader is told.
set(ENV{LD_LIBRARY_PATH} ${WORK}/root/usr/${LIBDIR})
run(${WORK}/root/usr/bin/simdbezier tessellate builtin:teapot --grid 4 -o ${WORK}/teapot.ply)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/consumer -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX}
    -DCMAKE_PREFIX_PATH=${WORK}/root/usr)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
run(${WORK}/consumer/consumer)
if(NOT output MATCHES "corner 0 0 0")
  message(FATAL_ERROR "the consumer printed: ${output}")
endif()
