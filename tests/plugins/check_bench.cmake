include(${CMAKE_CURRENT_LIST_DIR}/run_plugins.cmake)
run_plugins(--benchmark_min_time=0.001 --benchmark_filter=^grid/position/f32/.*/8x8/cache/threads:1$)
expect("no_symbol.so: expected sbe_evaluate_f32 or sbe_evaluate_f64, found neither"
       "missing.so: expected a shared object"
       "grid/position/f32/my_de_casteljau/8x8/cache/threads:1[^\n]*items_per_second"
       "grid/position/f32/shader_horner/8x8/cache/threads:1[^\n]*items_per_second"
       "crash/8x8[^\n]*ERROR[^\n]*crash.so: sbe_evaluate_f32 ended its process: Aborted"
       "nan/8x8[^\n]*ERROR[^\n]*nan.so: position is nan, or was not written, at sample 2 of patch 0"
       "writes_behind/8x8[^\n]*ERROR[^\n]*sbe_evaluate_f32 wrote behind position"
       "writes_before/8x8[^\n]*ERROR[^\n]*sbe_evaluate_f32 wrote before position"
       "changes_input/8x8[^\n]*ERROR[^\n]*sbe_evaluate_f32 changed u"
       "refuses_late/8x8[^\n]*ERROR[^\n]*returned 5 for bicubic patches"
       "grid/position/f32/(avx2|avx512|sse2|neon64|scalar)/8x8/cache/threads:1[^\n]*items_per_second")
