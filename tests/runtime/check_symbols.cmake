# cmake -DNM=… -DOBJDUMP=… -DISA=avx2 -DCOMPACT=0 -DOPTIMISED=1 -DOBJECTS=a.o;b.o -P check_symbols.cmake
# Fails on an object with more code than its budget, on a weak or global definition whose name does
# not carry the instruction set, on initialisers that would run on every machine, and where a
# kernel's prefetches are missing, which compilers drop from functions that seem to do nothing else.

# KB of code that the kernels may have, so that a new strategy does not go unnoticed: the largest of
# all instruction sets, rounded up.
set(budget_bicubic 1460)
set(budget_shape 650)
set(budget_curve 500)
set(budget_net 210)
set(budget_mesh 65)

foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} --defined-only ${object} OUTPUT_VARIABLE symbols
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]* [TWVuDRB] [^\n]+" definitions "${symbols}")
  list(LENGTH definitions count)
  if(count EQUAL 0)
    message(FATAL_ERROR "${object}: no definitions found, so this check sees nothing")
  endif()
  foreach(definition IN LISTS definitions)
    if(NOT definition MATCHES "isa_${ISA}")
      message(SEND_ERROR "${object}: ${definition} does not carry isa_${ISA}")
    endif()
  endforeach()
  execute_process(COMMAND ${OBJDUMP} -h ${object} OUTPUT_VARIABLE sections
                  COMMAND_ERROR_IS_FATAL ANY)
  if(sections MATCHES "\\.(init_array|ctors)")
    message(SEND_ERROR "${object}: has initialisers that run at load time")
  endif()
  if(OPTIMISED AND object MATCHES "([a-z]+)(_f[0-9]+)?_kernels\\.cpp")
    set(budget ${budget_${CMAKE_MATCH_1}})
    set(bytes 0)
    string(REGEX MATCHALL "\\.text[^ ]* +[0-9a-f]+" parts "${sections}")
    foreach(part IN LISTS parts)
      string(REGEX REPLACE "^[^ ]+ +" "0x" size "${part}")
      math(EXPR bytes "${bytes} + ${size}")
    endforeach()
    if(NOT parts OR bytes GREATER ${budget}000)
      message(SEND_ERROR "${object}: ${bytes} bytes of code, and ${budget} KB are allowed")
    endif()
  endif()
  set(prefetching)
  if(object MATCHES "shape_f")
    set(prefetching scatter_shape)
  elseif(object MATCHES "bicubic_kernels" AND NOT COMPACT)
    set(prefetching sweep_tile PagesAhead drain_owed)
  endif()
  if(prefetching)
    execute_process(
      COMMAND ${OBJDUMP} -d --no-show-raw-insn ${object}
      COMMAND awk "/^[0-9a-f]+ </ { name = $2 } /\t(prefetch|prfm)/ { print name }"
      OUTPUT_VARIABLE functions COMMAND_ERROR_IS_FATAL ANY)
    foreach(function IN LISTS prefetching)
      if(NOT functions MATCHES ${function})
        message(SEND_ERROR "${object}: no prefetch in ${function}")
      endif()
    endforeach()
  endif()
endforeach()
