# The MPI that simdbezier-mpi is built with.
set(SIMDBEZIER_MPI "" CACHE STRING
    "Which MPI, where there are several (Debian): openmpi or mpich; empty: the one CMake finds")
if(SIMDBEZIER_MPI)
  find_program(MPI_CXX_COMPILER mpicxx.${SIMDBEZIER_MPI} REQUIRED)
  find_program(MPIEXEC_EXECUTABLE mpirun.${SIMDBEZIER_MPI} REQUIRED)
endif()
find_package(MPI REQUIRED COMPONENTS CXX)
enable_language(C) # which finding HDF5 takes

# simdbezier_add_mpi_program(TARGET LIBRARY): the program, with this MPI. Tests build it with another
# one as well.
set(simdbezier_mpi_folder ${CMAKE_CURRENT_LIST_DIR} CACHE INTERNAL "")
function(simdbezier_add_mpi_program target library)
  set(sources main.cpp mpi_evaluate.cpp mpi_tessellate.cpp rank_file.cpp rank_stats.cpp
              rank_writers.cpp ranks.cpp)
  # One process makes VTKHDF files before all others write, so HDF5 need not know of MPI.
  find_package(HDF5 1.10.7 QUIET COMPONENTS C)
  if(HDF5_FOUND)
    list(APPEND sources hdf_file.cpp)
    list(APPEND library hdf5::hdf5)
  else()
    message(STATUS "HDF5 is absent: ${target} writes no .hdf files")
  endif()
  list(TRANSFORM sources PREPEND ${simdbezier_mpi_folder}/)
  add_executable(${target} ${sources})
  # Of MPI, only the C interface is used.
  target_compile_definitions(${target} PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX
                                               SIMDBEZIER_HDF5=$<BOOL:${HDF5_FOUND}>)
  target_link_libraries(${target} PRIVATE simdbezier_commands ${library})
endfunction()
