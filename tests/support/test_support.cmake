# What all code of tests is compiled with.
include_guard(GLOBAL)

set(SIMDBEZIER_SHARED_DATA "$ENV{SIMDBEZIER_SHARED_DATA}"
    CACHE PATH "Folder of larger patch sets; tests that need them skip where it is absent")

add_library(simdbezier_test_support INTERFACE)
target_compile_definitions(simdbezier_test_support
                           INTERFACE SIMDBEZIER_SHARED_DATA="${SIMDBEZIER_SHARED_DATA}")
# g++ 12 at -O3 drops the rounding in double(float(x)) - y where it vectorises two such statements
# side by side, and with it the meaning of "the net as rounded to float".
target_compile_options(simdbezier_test_support
                       INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
# Tests spend their time in the library; at -O3 they take three times as long to compile.
target_compile_options(simdbezier_test_support INTERFACE $<$<NOT:$<CONFIG:Debug>>:-Og>)

# The oracle is compiled once, because tests spend most of their own time in it.
add_library(simdbezier_oracle STATIC ${CMAKE_CURRENT_LIST_DIR}/oracle/oracle.cpp)
target_link_libraries(simdbezier_oracle PRIVATE simdbezier_test_support simdbezier_private_flags)
set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/oracle/oracle.cpp
                            PROPERTIES COMPILE_OPTIONS $<$<NOT:$<CONFIG:Debug>>:-O2>)
