# The instruction sets: the only place in the project with -m flags, and the only list of them besides
# the enumeration Isa. One row each, narrowest first:
# name | processors | xsimd architecture tag | fuses | compact | compiler flags
#   fuses: a multiplication and an addition have one rounding. xsimd's fma() for the tag has to be
#     one instruction then.
#   compact: 1: no machine depends on the set; 2: only bicubic patches and curves have kernels of their own, for few machines
#     and for code that goes over a network (kCompact and kCompactShapes in kernels/simd/vector.hpp).
#   flags: those of the form -mNAME name what a machine must have, in the compilers' words. Tuned for
#     generic machines, g++ 12 spills addresses to vector registers, where they queue behind the
#     arithmetic: 18 % of the derivatives' speed on AVX-512.
set(simdbezier_isa_rows
    "scalar|any|void|0|1|"
    "sse2|x86_64|xsimd::sse2|0|2|-msse2 -mtune=haswell"
    "simd128|wasm32|xsimd::sse2|0|2|-msimd128 -D__SSE__ -D__SSE2__"
    "avx2|x86_64|xsimd::fma3<xsimd::avx2>|1|0|-mavx2 -mfma -mtune=haswell"
    "avx512|x86_64|xsimd::avx512bw|1|0|-mavx512f -mavx512cd -mavx512dq -mavx512bw -mavx512vl -mavx2 -mfma -mtune=haswell"
    "neon64|aarch64|xsimd::neon64|1|0|")
set(simdbezier_pic ON)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  set(simdbezier_processors x86_64)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  set(simdbezier_processors aarch64)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "wasm32")
  set(simdbezier_processors wasm32)
  set(simdbezier_pic OFF) # it would be code for modules that are linked at run time
else()
  set(simdbezier_processors other)
endif()

# Takes a row apart into PREFIX_name, _processors, _arch, _fuses, _compact, and _flags, a list.
function(simdbezier_read_isa_row row prefix)
  string(REPLACE "|" ";" fields "${row};")
  foreach(column IN ITEMS name processors arch fuses compact flags)
    list(POP_FRONT fields value)
    set(${prefix}_${column} "${value}" PARENT_SCOPE)
  endforeach()
  separate_arguments(value)
  set(${prefix}_flags ${value} PARENT_SCOPE)
endfunction()

# What a machine must have for flags, in the compilers' words.
function(simdbezier_isa_needs flags result)
  list(FILTER flags INCLUDE REGEX "^-m[a-z0-9.]+$")
  list(TRANSFORM flags REPLACE "^-m" "")
  set(${result} ${flags} PARENT_SCOPE)
endfunction()

# The rows of the processor's family.
set(SIMDBEZIER_ISA_TABLE ${simdbezier_isa_rows})
list(FILTER SIMDBEZIER_ISA_TABLE INCLUDE REGEX "^[a-z0-9_]+[|](any|${simdbezier_processors})[|]")

# The widest instruction set of the machine that builds. Where Linux does not say what the processor
# has, that is the widest one which needs nothing.
function(simdbezier_widest_isa result)
  set(words "")
  if(EXISTS /proc/cpuinfo)
    file(STRINGS /proc/cpuinfo words REGEX "^flags" LIMIT_COUNT 1)
  endif()
  separate_arguments(words)
  foreach(row IN LISTS SIMDBEZIER_ISA_TABLE)
    simdbezier_read_isa_row("${row}" row)
    simdbezier_isa_needs("${row_flags}" needs)
    list(TRANSFORM needs REPLACE "[.]" "_") # as Linux writes sse4.2
    list(REMOVE_ITEM needs "" ${words})
    if("${needs}" STREQUAL "")
      set(${result} ${row_name} PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# A build that names instruction sets contains these and no others: calls on a machine that has none
# of them return Status::unsupported_isa.
set(SIMDBEZIER_ISAS "" CACHE STRING
    "Instruction sets to build, for example avx2;avx512; native: the widest of this machine; empty: all of the processor's family")
set(simdbezier_known_isas ${SIMDBEZIER_ISA_TABLE})
list(TRANSFORM simdbezier_known_isas REPLACE "[|].*" "")
set(simdbezier_wanted_isas ${SIMDBEZIER_ISAS})
if("native" IN_LIST simdbezier_wanted_isas)
  simdbezier_widest_isa(widest)
  list(TRANSFORM simdbezier_wanted_isas REPLACE "^native$" "${widest}")
endif()
foreach(isa IN LISTS simdbezier_wanted_isas)
  if(NOT isa IN_LIST simdbezier_known_isas)
    list(JOIN simdbezier_known_isas ", " known)
    message(FATAL_ERROR "SIMDBEZIER_ISAS: expected some of ${known}, or native, found '${isa}'")
  endif()
endforeach()
if(simdbezier_wanted_isas)
  list(JOIN simdbezier_wanted_isas "|" wanted)
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

# For all sources but kernels. g++ clears a structure of some hundred bytes by one instruction, which
# takes 25 cycles to begin. With plain stores instead, a call on a few samples takes 0.8 of its time
# (Zen 5).
set(simdbezier_call_flags -mmemset-strategy=unrolled_loop:1024:noalign,libcall:-1:noalign)
check_cxx_compiler_flag(${simdbezier_call_flags} SIMDBEZIER_HAS_MEMSET_STRATEGY)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "wasm32")
  # Exceptions are WebAssembly's own (web/runtime/), and what is loaded over a network is to be small. libc++ and
  # sizes of 32 bits bring warnings that no other build has: they are shown, but stop no build.
  set(simdbezier_call_flags -O2 -msimd128 -fwasm-exceptions -Wno-error=shorten-64-to-32 -Wno-error=shadow)
elseif(NOT SIMDBEZIER_HAS_MEMSET_STRATEGY)
  set(simdbezier_call_flags "")
endif()

# The flags of one instruction set, as a list.
function(simdbezier_isa_flags name result)
  foreach(row IN LISTS SIMDBEZIER_ISA_TABLE)
    simdbezier_read_isa_row("${row}" row)
    if(row_name STREQUAL name)
      set(${result} ${row_flags} ${simdbezier_jump_flags} PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# The flags of the kernels besides those of their instruction set.
#
# Without optimisation xsimd's small functions leave weak symbols behind that the linker could hand
# to objects of another instruction set (tests/runtime/check_symbols.cmake watches). -O3 in every
# other build: below it g++ 12 keeps the registers' arrays in memory, which costs a factor of two;
# compact sets have -O2, which is half the work and half the code. No errno: sqrt becomes one
# instruction. No exceptions: their personality routine would be one more symbol to merge. Without
# -fno-ivopts and -fno-tree-pre g++ 12 makes many addresses of a sweep's few, most of them on the
# stack: 10 % of the speed of 8 x 8 and 17 x 17 positions.
# Its SLP vectoriser joins loads of fields that were stored one by one, which then wait for streaming
# stores (src/tables/drain_queue.hpp); and it drops the rounding to float where two statements like
# double(float(x)) - y stand side by side, as they do in packing.
# Clones of functions for one argument are what templates are for, where they pay.
# g++ 12 warns about its own _mm512_undefined_ps (GCC bug 105593).
function(simdbezier_kernel_options object compact)
  set(level -O3)
  if(compact EQUAL 1)
    set(level -O2)
  endif()
  target_compile_options(
    ${object} PRIVATE $<IF:$<CONFIG:Debug>,-O1,${level}> -fno-math-errno -fno-exceptions
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
endfunction()

# Compiles the kernels for the instruction set of a row, as the objects simdbezier_kernels_NAME.
function(simdbezier_add_kernel_objects row)
  simdbezier_read_isa_row("${row}" row)
  simdbezier_isa_flags(${row_name} flags)
  string(TOUPPER ${row_name} upper)
  set(object simdbezier_kernels_${row_name})
  set(folder ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../kernels)
  set(shape_sources ${folder}/shape_f32_kernels.cpp ${folder}/shape_f64_kernels.cpp)
  add_library(${object} OBJECT ${folder}/bicubic_kernels.cpp ${shape_sources}
              ${folder}/curve_kernels.cpp ${folder}/net_kernels.cpp ${folder}/mesh_kernels.cpp)
  # g++ spends most of the time of these two on the question whether a store changes what a later load
  # reads. With a seventh of its limit for that, they take a tenth less, at the same speed
  # (390 rows of grids on a Zen 5: 0.999 by geometric mean).
  set_source_files_properties(
    ${shape_sources} PROPERTIES
    COMPILE_OPTIONS $<$<CXX_COMPILER_ID:GNU>:--param=sccvn-max-alias-queries-per-access=150>)
  # Alone even where other sources are compiled several as one: the longest ones of a build must run
  # side by side.
  set_target_properties(${object} PROPERTIES UNITY_BUILD OFF)
  target_compile_definitions(
    ${object} PRIVATE SIMDBEZIER_ISA=${row_name} SIMDBEZIER_ARCH=${row_arch}
                      SIMDBEZIER_KERNELS_${upper} SIMDBEZIER_FUSES=${row_fuses}
                      SIMDBEZIER_COMPACT=${row_compact})
  target_compile_options(${object} PRIVATE ${flags})
  simdbezier_kernel_options(${object} ${row_compact})
  target_link_libraries(${object} PRIVATE simdbezier_private_flags simdbezier_xsimd)
  set_target_properties(${object} PROPERTIES POSITION_INDEPENDENT_CODE ${simdbezier_pic})
endfunction()

# Writes the table as C++ source: SIMDBEZIER_INSTRUCTION_SET(name, NAME, fuses, runs_here), one a
# line, of all families. runs_here is an expression over SIMDBEZIER_CPU_HAS(feature).
function(simdbezier_write_instruction_sets file)
  set(lines "")
  foreach(row IN LISTS simdbezier_isa_rows)
    simdbezier_read_isa_row("${row}" row)
    string(TOUPPER ${row_name} upper)
    set(runs_here false)
    if(row_processors MATCHES "^(any|${simdbezier_processors})$")
      simdbezier_isa_needs("${row_flags}" needs)
      list(TRANSFORM needs REPLACE "(.+)" "SIMDBEZIER_CPU_HAS(\"\\1\")")
      list(PREPEND needs true)
      list(JOIN needs " && " runs_here)
    endif()
    string(APPEND lines
           "SIMDBEZIER_INSTRUCTION_SET(${row_name}, ${upper}, ${row_fuses} != 0, ${runs_here})\n")
  endforeach()
  file(CONFIGURE OUTPUT ${file} CONTENT "${lines}")
endfunction()

# Compiles the kernels once per instruction set, and appends the objects to `target`. The folder
# `generated` gets isa_list.inc, which lists them for src/runtime/dispatch.cpp, and
# instruction_sets.inc.
function(simdbezier_add_isa_kernels target)
  # Nets have many loops, few of them hot, and are moved value by value where they are not packed:
  # vectorised, and unrolled as far as sweeps need it, these were a third more code and no faster.
  # Below 100 g++ leaves transposes in memory (kernels/nets/net_group.hpp).
  set_property(SOURCE ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../kernels/net_kernels.cpp
               APPEND PROPERTY COMPILE_OPTIONS
               "$<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize;--param=max-completely-peeled-insns=100>")
  set(entries "")
  foreach(row IN LISTS SIMDBEZIER_ISA_TABLE)
    simdbezier_add_kernel_objects("${row}")
    simdbezier_read_isa_row("${row}" row)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:simdbezier_kernels_${row_name}>)
    string(APPEND entries " X(${row_name}, __VA_ARGS__)")
  endforeach()
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/generated)
  file(CONFIGURE OUTPUT ${generated}/isa_list.inc CONTENT "#define SIMDBEZIER_EACH_ISA(X, ...)${entries}\n")
  simdbezier_write_instruction_sets(${generated}/instruction_sets.inc)
  target_include_directories(${target} PRIVATE ${generated})
endfunction()
