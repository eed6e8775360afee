# Under emscripten: the libraries this one needs are taken as headers, from where the system has them. The system's own
# headers, which lie beside them, belong to another machine, so a folder of links is searched in their place.
set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
function(shearfront_header_package package target header)
  find_path(${package}_headers ${header} PATHS /usr/include /usr/include/eigen3 /usr/local/include
            NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  get_filename_component(folder ${header} DIRECTORY)
  file(CREATE_LINK ${${package}_headers}/${folder} ${headers}/${folder} SYMBOLIC)
  file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}Config.cmake
       "if(NOT TARGET ${target})
          add_library(${target} INTERFACE IMPORTED)
          target_include_directories(${target} SYSTEM INTERFACE ${headers})
          target_compile_definitions(${target} INTERFACE ${ARGN})
        endif()\n")
  file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}ConfigVersion.cmake
       "set(PACKAGE_VERSION 99)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
endfunction()
shearfront_header_package(Boost Boost::headers boost/version.hpp)
shearfront_header_package(tomlplusplus tomlplusplus::tomlplusplus toml++/toml.h TOML_HEADER_ONLY=1)
shearfront_header_package(nlohmann_json nlohmann_json::nlohmann_json nlohmann/json.hpp)
shearfront_header_package(fmt fmt::fmt fmt/format.h FMT_HEADER_ONLY=1)
shearfront_header_package(FastFloat FastFloat::fast_float fast_float/fast_float.h)
shearfront_header_package(Eigen3 Eigen3::Eigen Eigen/Core)
