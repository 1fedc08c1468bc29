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
       # Everything that runs is ranked beside the library.
       "ranking of P/f32 over [0-9]+ families" "[0-9]+[.] my_de_casteljau" "[0-9]+[.] shader_horner"
       # Shapes that an evaluator does not know are left out.
       "random_7x7/f32 +my_de_casteljau")
expect_none("G5, RMS" # says nothing of so few samples
            "random_7x7/f32 +shader_horner" "weights4_3x3/f32 +my_de_casteljau"
            "FAILED [^ ]+/P/my_de_casteljau")
file(READ ${FOLDER}/accuracy.json json)
set(output "${json}")
expect("\"class\": \"plugin\",\n +\"isa\": \"shader_horner\"")
