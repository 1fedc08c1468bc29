# Toolchain for WebAssembly by Debian's clang 19, as a module without threads for Node and browsers
# (`./run web` installs what it needs). Of emscripten only files are used: its headers, which write SSE2's
# intrinsics as those of simd128, and the part of LLVM's libc++abi for exceptions, which Debian's lacks.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_AR llvm-ar-19)
set(CMAKE_RANLIB llvm-ranlib-19)
foreach(language C CXX)
  set(CMAKE_${language}_COMPILER_TARGET wasm32-wasi)
endforeach()
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CROSSCOMPILING_EMULATOR node)
set(BUILD_SHARED_LIBS OFF CACHE BOOL "")
set(SIMDBEZIER_THREADS none CACHE STRING "")
set(SIMDBEZIER_INSTALL OFF CACHE BOOL "")
set(SIMDBEZIER_EMSCRIPTEN /usr/share/emscripten/system CACHE PATH "Where emscripten's sources are")

# Folders of links, since /usr/include as a whole is the C library of the machine that builds.
set(wasm_headers ${CMAKE_BINARY_DIR}/wasm_headers)
foreach(library xsimd fast_float)
  file(MAKE_DIRECTORY ${wasm_headers})
  file(CREATE_LINK /usr/include/${library} ${wasm_headers}/${library} SYMBOLIC)
endforeach()
foreach(header xmmintrin emmintrin pmmintrin immintrin)
  file(CREATE_LINK ${SIMDBEZIER_EMSCRIPTEN}/include/compat/${header}.h ${wasm_headers}/${header}.h SYMBOLIC)
endforeach()
set(SIMDBEZIER_XSIMD_INCLUDE_DIR ${wasm_headers} CACHE PATH "")

set(CMAKE_C_FLAGS_INIT "-mbulk-memory -mnontrapping-fptoint")
set(CMAKE_CXX_FLAGS_INIT "-mbulk-memory -mnontrapping-fptoint -Wno-deprecated-declarations")
