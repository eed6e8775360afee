# The toolchain of the preset web: that of the emscripten that is installed.
find_program(EM_CONFIG em-config REQUIRED)
execute_process(COMMAND ${EM_CONFIG} EMSCRIPTEN_ROOT OUTPUT_VARIABLE root OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
include(${root}/cmake/Modules/Platform/Emscripten.cmake)
# Exceptions of the engine are those of WebAssembly: a third smaller and faster than those through JavaScript.
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions")
# Small, for it is sent over the net. long double is made of software there, 128 bits wide.
set(CMAKE_CXX_FLAGS_RELEASE "-Os -DNDEBUG -DBOOST_MATH_PROMOTE_DOUBLE_POLICY=false" CACHE STRING "")
