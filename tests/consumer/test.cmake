# The program of the README's ten lines of C++, built as a user would: against the installed package, and with
# the sources as a subfolder. Building all of the library again takes a while: that one has the label slow.
set(consumer_flags "")
if(SHEARFRONT_SANITIZE)
  string(APPEND consumer_flags " -fsanitize=${SHEARFRONT_SANITIZE}")
endif()
if(SHEARFRONT_COVERAGE)
  string(APPEND consumer_flags " --coverage")
endif()
function(shearfront_consumer_test name label)
  add_test(NAME consumer.${name}
           COMMAND ${CMAKE_COMMAND} -D way=${name} -D source=${PROJECT_SOURCE_DIR} -D build=${PROJECT_BINARY_DIR}
                   -D work=${CMAKE_CURRENT_BINARY_DIR}/consumer/${name} -D generator=${CMAKE_GENERATOR}
                   -D compiler=${CMAKE_CXX_COMPILER} -D launcher=${CMAKE_CXX_COMPILER_LAUNCHER}
                   -D flags=${consumer_flags} -P ${CMAKE_CURRENT_SOURCE_DIR}/consumer/run.cmake)
  set_tests_properties(consumer.${name} PROPERTIES LABELS ${label})
endfunction()

shearfront_consumer_test(find_package consumer)
shearfront_consumer_test(add_subdirectory consumer)
shearfront_consumer_test(add_subdirectory_all slow)
