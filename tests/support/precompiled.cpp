// Nothing but the headers that CMakeLists.txt has precompiled for all tests.
