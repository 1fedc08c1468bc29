# The instruction sets: the only place in the project with -m flags.
# One row each: name | xsimd architecture tag | compiler flags. Narrowest first.
# Tuned for generic machines, g++ 12 spills addresses to vector registers, where they queue behind
# the arithmetic: 18 % of the derivatives' speed on AVX-512.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  set(SIMDBEZIER_ISA_TABLE
      "scalar|void|"
      "sse2|xsimd::sse2|-msse2"
      "avx2|xsimd::fma3<xsimd::avx2>|-mavx2 -mfma -mtune=haswell"
      "avx512|xsimd::avx512bw|-mavx512f -mavx512cd -mavx512dq -mavx512bw -mavx512vl -mavx2 -mfma -mtune=haswell")
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  set(SIMDBEZIER_ISA_TABLE "scalar|void|" "neon64|xsimd::neon64|")
else()
  set(SIMDBEZIER_ISA_TABLE "scalar|void|")
endif()

# A build that names instruction sets contains these and no others: calls on a machine that has none
# of them return Status::unsupported_isa.
set(SIMDBEZIER_ISAS "" CACHE STRING
    "Instruction sets to build, for example avx2;avx512; empty: all of the processor's family")
set(simdbezier_known_isas ${SIMDBEZIER_ISA_TABLE})
list(TRANSFORM simdbezier_known_isas REPLACE "[|].*" "")
foreach(isa IN LISTS SIMDBEZIER_ISAS)
  if(NOT isa IN_LIST simdbezier_known_isas)
    list(JOIN simdbezier_known_isas ", " known)
    message(FATAL_ERROR "SIMDBEZIER_ISAS: expected some of ${known}, found '${isa}'")
  endif()
endforeach()
if(SIMDBEZIER_ISAS)
  list(JOIN SIMDBEZIER_ISAS "|" wanted)
  list(FILTER SIMDBEZIER_ISA_TABLE INCLUDE REGEX "^(${wanted})[|]")
endif()

# For builds that are made to be judged, not to be used (coverage, mutations, sanitizers): flags that
# come behind all others.
set(SIMDBEZIER_KERNEL_FLAGS "" CACHE STRING "Further compiler flags of the kernels")
mark_as_advanced(SIMDBEZIER_KERNEL_FLAGS)

# Cores from Skylake to Cascade Lake do not cache decoded instructions around a jump that touches
# the end of 32 bytes (Intel's erratum on jump conditional code): whether a loop loses a third of
# its speed would be up to its address. g++ leaves that to the assembler.
include(CheckCXXCompilerFlag)
set(simdbezier_jump_flags "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  foreach(flag -mbranches-within-32B-boundaries -Wa,-mbranches-within-32B-boundaries)
    string(MAKE_C_IDENTIFIER "SIMDBEZIER_HAS${flag}" has_flag)
    check_cxx_compiler_flag(${flag} ${has_flag})
    if(${has_flag} AND simdbezier_jump_flags STREQUAL "")
      set(simdbezier_jump_flags ${flag})
    endif()
  endforeach()
endif()

# The flags of one instruction set, as a list.
function(simdbezier_isa_flags name result)
  foreach(row IN LISTS SIMDBEZIER_ISA_TABLE)
    string(REPLACE "|" ";" fields "${row};")
    list(GET fields 0 row_name)
    if(row_name STREQUAL name)
      list(GET fields 2 flags)
      separate_arguments(flags)
      set(${result} ${flags} ${simdbezier_jump_flags} PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# Compiles the kernels once per instruction set, appends the objects to `target` and lists
# them for src/runtime/dispatch.cpp in isa_list.inc.
function(simdbezier_add_isa_kernels target)
  # Nets have many loops, few of them hot, and are moved value by value where they are not packed:
  # vectorised, and unrolled as far as sweeps need it, these were a third more code and no faster.
  # Below 100 g++ leaves transposes in memory (kernels/simd/squares.hpp).
  set_property(SOURCE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../kernels/net_kernels.cpp
               APPEND PROPERTY COMPILE_OPTIONS
               "$<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize;--param=max-completely-peeled-insns=100>")
  set(entries "")
  foreach(row IN LISTS SIMDBEZIER_ISA_TABLE)
    string(REPLACE "|" ";" fields "${row};")
    list(GET fields 0 name)
    list(GET fields 1 arch)
    simdbezier_isa_flags(${name} flags)
    string(TOUPPER ${name} upper)
    set(object simdbezier_kernels_${name})
    set(sources bicubic_kernels.cpp shape_kernels.cpp curve_kernels.cpp net_kernels.cpp mesh_kernels.cpp)
    list(TRANSFORM sources PREPEND ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../kernels/)
    add_library(${object} OBJECT ${sources})
    # Alone even where other sources are compiled several as one: the longest ones of a build must
    # run side by side.
    set_target_properties(${object} PROPERTIES UNITY_BUILD OFF)
    set(level -O3)
    if(name MATCHES "^(scalar|sse2)$")
      set(level -O2)
    endif()
    target_compile_definitions(${object} PRIVATE SIMDBEZIER_ISA=${name} SIMDBEZIER_ARCH=${arch}
                                                 SIMDBEZIER_KERNELS_${upper})
    # Without optimisation xsimd's small functions leave weak symbols behind that the linker could
    # hand to objects of another instruction set (tests/runtime/check_symbols.cmake watches).
    # -O3 in every other build: below it g++ 12 keeps the registers' arrays in memory, which costs a
    # factor of two; compact sets (kCompact in kernels/simd/vector.hpp) have -O2, which is half the
    # work and half the code. No errno: sqrt becomes one instruction. No exceptions: their personality
    # routine would be one more symbol to merge. Without -fno-ivopts and -fno-tree-pre g++ 12 makes
    # many addresses of a sweep's few, most of them on the stack: 10 % of the speed of 8 x 8 and
    # 17 x 17 positions.
    # Its SLP vectoriser joins loads of fields that were stored one by one, which then wait for
    # streaming stores (src/tables/drain_queue.hpp); and it drops the rounding to float where two
    # statements like double(float(x)) - y stand side by side, as they do in packing.
    # Clones of functions for one argument are what templates are for, where they pay.
    # g++ 12 warns about its own _mm512_undefined_ps (GCC bug 105593).
    target_compile_options(
      ${object} PRIVATE ${flags} $<IF:$<CONFIG:Debug>,-O1,${level}> -fno-math-errno -fno-exceptions
                        "$<$<CXX_COMPILER_ID:GNU>:-fno-ivopts;-fno-tree-pre;-fno-tree-slp-vectorize;-fno-ipa-cp-clone>"
                        "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-uninitialized>")
    if(SIMDBEZIER_SANITIZE)
      # All that is inlined here would take a sanitizing compiler minutes; a quarter of them where
      # scopes are not watched. Undefined behaviour of the kernels is looked for where
      # SIMDBEZIER_KERNEL_FLAGS say so (CMakePresets.json).
      target_compile_options(${object} PRIVATE -O1 -fno-sanitize=undefined)
      if(SIMDBEZIER_SANITIZE MATCHES address)
        target_compile_options(${object} PRIVATE -fno-sanitize-address-use-after-scope)
      endif()
    endif()
    separate_arguments(further UNIX_COMMAND "${SIMDBEZIER_KERNEL_FLAGS}")
    target_compile_options(${object} PRIVATE ${further})
    target_link_libraries(${object} PRIVATE simdbezier_private_flags simdbezier_xsimd)
    set_target_properties(${object} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${object}>)
    string(APPEND entries "SIMDBEZIER_ISA_ENTRY(${name})\n")
  endforeach()
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/generated)
  file(CONFIGURE OUTPUT ${generated}/isa_list.inc CONTENT "${entries}")
  target_include_directories(${target} PRIVATE ${generated})
endfunction()
