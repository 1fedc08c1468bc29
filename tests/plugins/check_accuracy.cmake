include(${CMAKE_CURRENT_LIST_DIR}/run_plugins.cmake)
run_plugins(--nets 2 --samples 6 --json ${FOLDER}/accuracy.json)
expect("no_symbol.so: expected sbe_evaluate_f32 or sbe_evaluate_f64, found neither"
       "missing.so: expected a shared object, found"
       # A family and a sample for every fault.
       "FAILED wave/f32/P/40_units: an error of (3[89]|4[0-9])[0-9.]* u, [12][.0-9]* times the library's bound .net [0-9]+, component [0-2], x [^ ]+, y"
       "FAILED wave/f32/crash: [^\n]*crash.so: sbe_evaluate_f32 ended its process: Aborted"
       "FAILED wave/f32/nan: [0-9]+ NaN values"
       "FAILED wave/f32/refuses_late: [^\n]*refuses_late.so: returned 5 for a patch"
       "FAILED wave/f32/writes_behind: [^\n]*writes_behind.so: sbe_evaluate_f32 wrote behind position"
       "FAILED wave/f32/writes_before: [^\n]*writes_before.so: sbe_evaluate_f32 wrote before position"
       "FAILED wave/f32/changes_input: [^\n]*changes_input.so: sbe_evaluate_f32 changed u"
       "[0-9]+[.] odd__name___ " "[0-9]+[.] no_name "
       "FAILED wave/f32/behind_plane: [^\n]*behind_plane.so: sbe_evaluate_planes_f32 wrote behind dv"
       "FAILED wave/f32/Duv/duv_off: an error of [0-9.e+]+ u, .*times the library's bound .net 0, component 1,"
       # Everything that runs is ranked beside the library.
       "ranking of P/f32 over [0-9]+ families" "[0-9]+[.] my_de_casteljau" "[0-9]+[.] shader_horner"
       "ranking of Duv/f32 over [0-9]+ families" "ranking of N/f32 over [0-9]+ families"
       "[0-9]+[.] nan +not finite"
       # Shapes that an evaluator does not know are left out.
       "random_7x7/f32 +my_de_casteljau")
expect_none("G5, RMS" # says nothing of so few samples
            "random_7x7/f32 +shader_horner" "weights4_3x3/f32 +my_de_casteljau"
            "FAILED [^ ]+/P/my_de_casteljau" "FAILED [a-z0-9]+/f32/[A-Za-z]+/none_in_planes"
            "[0-9]+[.] [^\n]* inf" "Duu/shader_horner" "constant[^\n]*/(shader_horner|my_de_casteljau): an error of inf")
file(READ ${FOLDER}/accuracy.json json)
set(output "${json}")
expect("\"class\": \"plugin\",\n +\"isa\": \"shader_horner\"")

# An evaluator's own figures: written, read again, and missed. The file has one class of the library at
# the most, as that of a build for one machine.
set(thresholds ${FOLDER}/thresholds.json)
set(part --quick --filter "^(wave|constant)/f32/(scalar|40_units)$" --evaluator ${FOLDER}/40_units.so
         --thresholds ${thresholds})
run(1 ${part} --write-thresholds)
expect("FAILED wave/f32/P/40_units: an error of")
run(0 ${part})
run(2 --filter ^wave/f32/scalar$ --thresholds ${thresholds})
expect("expected figures of 500 nets and 100 samples, found those of 12 nets and 16 samples")
file(READ ${thresholds} text)
string(REGEX REPLACE "(plugin/40_units.*\"wave/f32/P\": .)[0-9.]+" "\\10.5" text "${text}")
file(WRITE ${thresholds} "${text}")
run(1 ${part})
expect("FAILED wave/f32/P/40_units: G2, max: [0-9.]+ where 0.525 is allowed" "1 failures")

foreach(option --nets --samples)
  foreach(value -1 0 2x a 1000001 18446744073709551618)
    run(2 --filter ^nothing$ ${option} ${value})
    expect("simdbezier_accuracy: ${option}: expected 1 to 1000000, found '${value}'")
  endforeach()
endforeach()
run(2 --filter ^nothing$)
expect("--filter .nothing.: nothing that was measured matches")
run(0 --help)
expect("--evaluator FILE.so" "--quick" "--filter REGEX")
