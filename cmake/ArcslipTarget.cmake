# How every library and program of Arcslip is compiled, and how a library shows its headers.

function(arcslip_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms of GCC 12 on "text" + std::string: https://gcc.gnu.org/bugzilla/show_bug.cgi?id=105651
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
  endif()
  if(ARCSLIP_SANITIZE)
    # A null pointer that is read or written ends with a report of the address sanitizer, and Eigen asserts the alignment
    # it needs: checks of both at every access would take a third of the time to compile and to run.
    target_compile_options(${target} PUBLIC $<BUILD_INTERFACE:-fsanitize=address,undefined;-fno-sanitize=null,alignment>
      $<BUILD_INTERFACE:-fno-sanitize-recover=all;-fno-omit-frame-pointer>)
    target_link_options(${target} PUBLIC $<BUILD_INTERFACE:-fsanitize=address,undefined>)
    # What is read before it is set is NaN.
    target_compile_definitions(${target} PUBLIC $<BUILD_INTERFACE:EIGEN_INITIALIZE_MATRICES_BY_NAN>)
  endif()
endfunction()

# Compiled once for all files of a target: what nearly each of them includes, and still includes by name.
# arcslip_common_headers(target FROM other): those of a target that is compiled with the same options.
function(arcslip_common_headers target)
  cmake_parse_arguments(arg "" "FROM" "" ${ARGN})
  if(arg_FROM)
    target_precompile_headers(${target} REUSE_FROM ${arg_FROM})
    return()
  endif()
  target_precompile_headers(${target} PRIVATE <Eigen/Core> <Eigen/SparseCore> <algorithm> <cmath> <complex>
    <functional> <limits> <memory> <optional> <span> <sstream> <stdexcept> <string> <utility> <variant> <vector> ${ARGN})
endfunction()

# arcslip_library(NAME [HEADERS_FROM other] [COMMON header...] ROOMS room... [LIGHT room or file...] FILES file...)
# makes arcslip_NAME (arcslip::NAME). ROOMS are pairs "link=folder": the folder is seen as <arcslip/link/...>.
# FILES begin with the link. The headers among them are public and get installed, as is NAME.hpp beside the CMakeLists.txt,
# the library's umbrella <arcslip/NAME.hpp>; a header that is not listed is private.
# LIGHT is what computes nothing in loops, which is compiled with -O1 in a third of the time. COMMON are headers of its own to
# compile once for all files; HEADERS_FROM is the library whose precompiled headers serve this one, too.
# A precompiled header is cheap where it only declares: each file compiles again what inline functions in it instantiate.
# Each library has a root of links of its own, so that an include of a library that is not linked does not compile.
function(arcslip_library name)
  cmake_parse_arguments(arg "" "HEADERS_FROM" "COMMON;ROOMS;LIGHT;FILES" ${ARGN})
  set(target arcslip_${name})
  set(root ${PROJECT_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${root}/arcslip)
  foreach(room IN LISTS arg_ROOMS)
    string(REPLACE "=" ";" pair ${room})
    list(GET pair 0 link)
    list(GET pair 1 folder_of_${link})
    file(CREATE_LINK ${folder_of_${link}} ${root}/arcslip/${link} SYMBOLIC)
  endforeach()
  configure_file(${name}.hpp ${root}/arcslip/${name}.hpp COPYONLY)  # a link to a file would be installed as one
  set(headers ${root}/arcslip/${name}.hpp)
  set(sources "")
  set(light "")
  foreach(file IN LISTS arg_FILES)
    string(REGEX MATCH "^[^/]+" link ${file})
    if(NOT DEFINED folder_of_${link})
      message(FATAL_ERROR "${file} of library ${name} is in none of its rooms: ${arg_ROOMS}")
    elseif(file MATCHES "\\.hpp$")
      list(APPEND headers ${root}/arcslip/${file})
    else()
      string(REGEX REPLACE "^[^/]+" "${folder_of_${link}}" path ${file})
      if(link IN_LIST arg_LIGHT OR file IN_LIST arg_LIGHT)
        list(APPEND light ${path})
      else()
        list(APPEND sources ${path})
      endif()
    endif()
  endforeach()
  add_library(${target} ${sources})
  add_library(arcslip::${name} ALIAS ${target})
  # Nothing asks for the macro that CMake defines in a shared library, and precompiled headers serve several.
  set_target_properties(${target} PROPERTIES DEFINE_SYMBOL "" EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${root} FILES ${headers})
  arcslip_compile_options(${target})
  set(from_heavy "")
  set(from_light "")
  if(arg_HEADERS_FROM)
    set(from_heavy FROM arcslip_${arg_HEADERS_FROM})
    if(TARGET arcslip_${arg_HEADERS_FROM}_light)
      set(from_light FROM arcslip_${arg_HEADERS_FROM}_light)
    endif()
  endif()
  arcslip_common_headers(${target} ${from_heavy} ${arg_COMMON})
  if(light)
    add_library(${target}_light OBJECT ${light})
    set_target_properties(${target}_light PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_include_directories(${target}_light PRIVATE ${root})
    arcslip_compile_options(${target}_light)
    target_compile_options(${target}_light PRIVATE $<$<CONFIG:Release>:-O1>)
    arcslip_common_headers(${target}_light ${from_light} ${arg_COMMON})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_light>)
  endif()
  install(TARGETS ${target} EXPORT arcslip
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()
