# Packages: `cpack -G DEB` in the build folder. One for each kind of user: who runs programs
# (runtime), who builds them (dev), who has patches in files (tools), who writes Python (python).
# With -DCMAKE_INSTALL_PREFIX=/usr the library goes to the system's folder for its architecture.
set(CPACK_PACKAGE_NAME simdbezier)
set(CPACK_PACKAGE_VENDOR simdbezier)
set(CPACK_PACKAGE_CONTACT "simdbezier maintainers <maintainers@simdbezier.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "evaluates many Bezier patches at many parameters in one call")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR})
set(CPACK_COMPONENTS_ALL dev)
if(simdbezier_type STREQUAL "SHARED_LIBRARY") # of a static one, nothing is needed to run programs
  list(PREPEND CPACK_COMPONENTS_ALL runtime)
endif()
if(TARGET simdbezier_cli)
  list(APPEND CPACK_COMPONENTS_ALL tools)
endif()
if(SIMDBEZIER_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(runtime_package libsimdbezier${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(dev_package libsimdbezier-dev)
set(tools_package simdbezier-tools)
set(python_package python3-simdbezier)
set(runtime_section libs)
set(dev_section libdevel)
set(tools_section graphics)
set(python_section python)
set(runtime_what "the shared library")
set(dev_what "headers, and what CMake and pkg-config need")
set(tools_what "the program that tessellates, evaluates and describes files")
set(python_what "the module for Python, on numpy arrays")
# dpkg-shlibdeps finds the library in the build folder, where it belongs to no package.
set(dev_depends "")
set(tools_depends "")
if(simdbezier_type STREQUAL "SHARED_LIBRARY")
  set(dev_depends "${runtime_package} (= ${PROJECT_VERSION})")
  set(tools_depends "${runtime_package} (>= ${PROJECT_VERSION})")
endif()
set(python_depends ${tools_depends})
if(SIMDBEZIER_BUILD_PYTHON) # extension modules are made for one version
  string(REPLACE "." ";" version ${SIMDBEZIER_MODULE_PYTHON_VERSION})
  list(GET version 1 minor)
  math(EXPR minor "${minor} + 1")
  list(APPEND python_depends "python3 (>= ${SIMDBEZIER_MODULE_PYTHON_VERSION})"
       "python3 (<< 3.${minor})" python3-numpy)
endif()
list(JOIN python_depends ", " python_depends)
set(long_description
    "Control points go in; positions, derivatives, normals or closed meshes of
triangles come out. Vector kernels are chosen when a program runs. Error
bounds are published, edges are watertight, and results depend neither on
threads nor on the machine.")

# Triggers' file as Debian wants it, and each package's copyright and changelog.
file(WRITE ${CMAKE_BINARY_DIR}/package/triggers "activate-noawait ldconfig\n")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
find_program(SIMDBEZIER_GZIP gzip)
mark_as_advanced(SIMDBEZIER_GZIP)
file(READ LICENSE license)
file(WRITE ${CMAKE_BINARY_DIR}/package/copyright
     "Upstream-Name: simdbezier\nLicense: MIT\n\n${license}")
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(package ${${component}_package})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${${component}_section})
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${${component}_depends}")
  set(CPACK_DEBIAN_${upper}_DESCRIPTION
      "${long_description}\nThis package has ${${component}_what}.")
  file(WRITE ${CMAKE_BINARY_DIR}/package/${component}/changelog
       "simdbezier (${PROJECT_VERSION}) unstable; urgency=medium\n\n"
       "  * See CHANGELOG.md of the sources.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  if(SIMDBEZIER_GZIP)
    execute_process(COMMAND ${SIMDBEZIER_GZIP} -9nf ${CMAKE_BINARY_DIR}/package/${component}/changelog
                    COMMAND_ERROR_IS_FATAL ANY)
    install(FILES ${CMAKE_BINARY_DIR}/package/${component}/changelog.gz
                  ${CMAKE_BINARY_DIR}/package/copyright
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
            COMPONENT ${component})
  endif()
endforeach()
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${CMAKE_BINARY_DIR}/package/triggers)
include(CPack)
