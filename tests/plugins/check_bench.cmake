include(${CMAKE_CURRENT_LIST_DIR}/run_plugins.cmake)
run_plugins(--benchmark_min_time=0.001 --benchmark_filter=^grid/position/f32/.*/8x8/cache/threads:1)
expect("no_symbol.so: expected sbe_evaluate_f32 or sbe_evaluate_f64, found neither"
       "missing.so: expected a shared object"
       "grid/position/f32/my_de_casteljau/8x8/cache/threads:1/layout:aos[^\n]*items_per_second"
       "grid/position/f32/shader_horner/8x8/cache/threads:1 [^\n]*items_per_second"
       "grid/position/f32/none_in_planes/8x8/cache/threads:1 [^\n]*items_per_second"
       "grid/position/f32/none_in_planes/8x8/cache/threads:1/layout:aos[^\n]*items_per_second"
       "crash/8x8[^\n]*ERROR[^\n]*crash.so: sbe_evaluate_f32 ended its process: Aborted"
       "nan/8x8[^\n]*ERROR[^\n]*nan.so: position is nan, or was not written, at sample 2 of patch 0"
       "writes_behind/8x8[^\n]*ERROR[^\n]*sbe_evaluate_f32 wrote behind position"
       "writes_before/8x8[^\n]*ERROR[^\n]*sbe_evaluate_f32 wrote before position"
       "changes_input/8x8[^\n]*ERROR[^\n]*sbe_evaluate_f32 changed u"
       "refuses_late/8x8[^\n]*ERROR[^\n]*returned 5 for bicubic patches"
       "grid/position/f32/(avx2|avx512|sse2|neon64|scalar)/8x8/cache/threads:1[^\n]*items_per_second")

# Rows of what is not refused, and only these.
run(1 --benchmark_min_time=0.001 --benchmark_filter=^grid/.*/f../.*_.*/4x4/cache
    --evaluator ${FOLDER}/shader_horner.so --evaluator ${FOLDER}/none_in_planes.so
    --evaluator ${FOLDER}/behind_plane.so --evaluator ${FOLDER}/duv_off.so)
foreach(outputs position position_normal position_derivatives)
  expect("grid/${outputs}/f32/shader_horner/4x4/cache/threads:1 [^\n]*items_per_second")
endforeach()
foreach(outputs position position_normal position_derivatives second_derivatives)
  expect("grid/${outputs}/f32/none_in_planes/4x4/cache/threads:1 [^\n]*items_per_second")
endforeach()
expect("second_derivatives/f32/duv_off/4x4[^\n]*ERROR[^\n]*wrong duv: patch 0 sample 2"
       "position_derivatives/f32/behind_plane/4x4[^\n]*ERROR[^\n]*sbe_evaluate_planes_f32 wrote behind dv"
       "position_derivatives/f32/none_in_planes/4x4/cache/threads:1/layout:aos[^\n]*items_per_second")
expect_none("second_derivatives/f32/shader_horner" "f64/shader_horner" "position_normal[^\n]*/layout:aos[^\n]*none"
            "second_derivatives/f32/none_in_planes/4x4/cache/threads:1/layout:aos")

# Without any of the evaluators that were asked for, no row is of interest.
run(1 --benchmark_min_time=0.001 --benchmark_filter=^grid/position/f32/.*/8x8/cache/threads:1
    --evaluator ${FOLDER}/missing.so --evaluator ${FOLDER}/no_symbol.so)
expect("missing.so: expected a shared object" "no_symbol.so: expected sbe_evaluate_f32")
expect_none("items_per_second")

run(1 --benchmark_filter=^nothing$)
expect("simdbezier_bench: --benchmark_filter: no row matches")
run(0 --help)
expect("--evaluator FILE.so")
