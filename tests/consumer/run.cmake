# way = find_package: install this build, configure, build and run the consumer against it.
# way = add_subdirectory: configure with the sources as a subfolder and compile the consumer's own file.
# way = add_subdirectory_all: the same, with everything built and run.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nexit code ${code}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${work})
set(configure ${CMAKE_COMMAND} -G ${generator} -B ${work}/build -D CMAKE_CXX_COMPILER=${compiler}
              -D CMAKE_CXX_COMPILER_LAUNCHER=${launcher} -D "CMAKE_CXX_FLAGS=-O0 ${flags}")
if(way STREQUAL "find_package")
  run(${CMAKE_COMMAND} --install ${build} --prefix ${work}/prefix)
  # Whatever is installed can be included, and is little enough to be read.
  file(GLOB_RECURSE headers RELATIVE ${work}/prefix/include ${work}/prefix/include/*.hpp)
  # Beside one header for each model of a list.
  set(models ${headers})
  list(FILTER models INCLUDE REGEX "/model/[a-z_]+/")
  list(FILTER models EXCLUDE REGEX "/(all|model|flux)[.]hpp$|/rheology/")
  list(LENGTH models n_models)
  list(LENGTH headers n_headers)
  math(EXPR n_others "${n_headers} - ${n_models}")
  if(n_others GREATER 48)
    message(FATAL_ERROR "${n_headers} headers are installed, at most 48 besides the ${n_models} of models are public")
  endif()
  list(TRANSFORM headers REPLACE "(.+)" "#include \"\\1\"\n")
  file(WRITE ${work}/installed_headers.cpp ${headers})
  run(${configure} -S ${source}/tests/consumer/installed -D CMAKE_PREFIX_PATH=${work}/prefix
                   -D installed_headers=${work}/installed_headers.cpp)
  run(${CMAKE_COMMAND} --build ${work}/build --target installed_headers)
  set(where timeline/)
else()
  run(${configure} -S ${source}/tests/consumer/subdirectory -D shearfront_source=${source})
endif()
if(way STREQUAL "add_subdirectory")
  run(${CMAKE_COMMAND} --build ${work}/build --target timeline_object)
  return()
endif()
run(${CMAKE_COMMAND} --build ${work}/build --target timeline)
execute_process(COMMAND ${work}/build/${where}timeline ${source}/datasets/may-2010-piecewise/scene.toml
                RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors)
file(READ ${source}/tests/consumer/expected.txt expected)
if(NOT code EQUAL 0 OR NOT output STREQUAL expected)
  message(FATAL_ERROR "expected\n${expected}\nbut exit code ${code} and\n${output}${errors}")
endif()
