# run_plugins(ARGUMENTS…): the program with all plug-ins; fails where it dies itself. Leaves what it
# printed in `output`.
function(run_plugins)
  set(evaluators "")
  foreach(name de_casteljau shader_horner ${FAULTS} missing)
    list(APPEND evaluators --evaluator ${FOLDER}/${name}.so)
  endforeach()
  execute_process(COMMAND ${PROGRAM} ${ARGN} ${evaluators} RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT result EQUAL 1) # some are at fault, and that is all
    message(FATAL_ERROR "exit code ${result}:\n${output}${errors}")
  endif()
  set(output "${output}${errors}" PARENT_SCOPE)
endfunction()

# run(CODE ARGUMENTS…): the program, which has to exit with CODE. Leaves what it printed in `output`.
function(run code)
  execute_process(COMMAND ${PROGRAM} ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT result EQUAL code)
    message(FATAL_ERROR "${ARGN}: expected exit code ${code}, found ${result}:\n${output}${errors}")
  endif()
  set(output "${output}${errors}" PARENT_SCOPE)
endfunction()

function(expect)
  foreach(pattern IN LISTS ARGN)
    if(NOT output MATCHES "${pattern}")
      message(FATAL_ERROR "expected ${pattern} in\n${output}")
    endif()
  endforeach()
endfunction()

function(expect_none)
  foreach(pattern IN LISTS ARGN)
    if(output MATCHES "${pattern}")
      message(FATAL_ERROR "expected nothing like ${pattern} in\n${output}")
    endif()
  endforeach()
endfunction()
