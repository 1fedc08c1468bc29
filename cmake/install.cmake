# Installed tree: library, headers, CMake package, pkg-config file.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/simdbezier)
install(
  TARGETS simdbezier
  EXPORT simdbezierTargets
  LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev
  ARCHIVE COMPONENT dev)
install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
install(EXPORT simdbezierTargets NAMESPACE simdbezier:: DESTINATION ${package_dir} COMPONENT dev)

configure_package_config_file(cmake/simdbezierConfig.cmake.in simdbezierConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(simdbezierConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/simdbezierConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/simdbezierConfigVersion.cmake
        DESTINATION ${package_dir}
        COMPONENT dev)

# A static library hands C++'s and its threads' runtime on to whoever links it; a shared one does not.
set(pc_libs_private "")
set(pc_cflags "")
if(simdbezier_type STREQUAL "STATIC_LIBRARY")
  set(pc_cflags "-DSIMDBEZIER_STATIC")
  if(SIMDBEZIER_THREADS STREQUAL "openmp")
    foreach(name IN LISTS OpenMP_CXX_LIB_NAMES)
      string(APPEND pc_libs_private " -l${name}")
    endforeach()
  elseif(SIMDBEZIER_THREADS STREQUAL "std")
    set(pc_libs_private " -pthread")
  endif()
  foreach(name IN ITEMS stdc++ c++) # a C program's linker adds neither
    if(name IN_LIST CMAKE_CXX_IMPLICIT_LINK_LIBRARIES)
      string(APPEND pc_libs_private " -l${name}")
    endif()
  endforeach()
  if("m" IN_LIST CMAKE_CXX_IMPLICIT_LINK_LIBRARIES)
    string(APPEND pc_libs_private " -lm")
  endif()
endif()
# Relative to the file itself, so that `cmake --install --prefix` and moved trees work.
file(RELATIVE_PATH pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
foreach(dir IN ITEMS LIBDIR INCLUDEDIR)
  string(TOLOWER pc_${dir} variable)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${dir}}")
    set(${variable} "${CMAKE_INSTALL_${dir}}")
  else()
    set(${variable} "\${prefix}/${CMAKE_INSTALL_${dir}}")
  endif()
endforeach()
configure_file(cmake/simdbezier.pc.in simdbezier.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/simdbezier.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT dev)

if(PROJECT_IS_TOP_LEVEL)
  include(cmake/package.cmake)
endif()
