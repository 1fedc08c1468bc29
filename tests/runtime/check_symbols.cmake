# cmake -DNM=… -DOBJDUMP=… -DISA=avx2 -DOBJECTS=a.o;b.o -P check_symbols.cmake
# Fails on a weak or global definition whose name does not carry the instruction set, and on
# initialisers that would run on every machine.
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
endforeach()
