# How every library and program of Arcslip is compiled, and how a library shows its headers.

include(ArcslipFlags)

# Compiled once for all files that reuse it: Eigen and std, which nearly each of them includes, and still includes by name,
# and that products of matrices are compiled once. No other header of the project, so that a change of one compiles only
# what includes it.
set(arcslip_common_headers <Eigen/Core> <Eigen/SparseCore> <algorithm> <cmath> <complex> <functional> <limits> <map>
  <memory> <optional> <span> <sstream> <stdexcept> <string> <utility> <variant> <vector>
  <arcslip/continuation/linear/compiled_products.hpp>)

# arcslip_precompiled_headers(NAME [header...]) makes the object library NAME for target_precompile_headers(... REUSE_FROM NAME),
# which serves targets that are compiled with the same options.
function(arcslip_precompiled_headers target)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp CONTENT "")
  add_library(${target} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  target_link_libraries(${target} PRIVATE Eigen3::Eigen)
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/include/continuation)
  arcslip_compile_options(${target})
  target_precompile_headers(${target} PRIVATE ${arcslip_common_headers} ${ARGN})
endfunction()

# The sources of a target in batches: one batch is one translation unit, which compiles what its files include, and the
# templates that they instantiate, once. The files of a batch are of one room, so that names at file level have to be unique
# in a room of lib, in continuation and in optimize, and not beyond. Where ARCSLIP_UNITY is off, each file is compiled alone.
set(ARCSLIP_BATCH 96000 CACHE STRING "Bytes of source of a batch, about")
mark_as_advanced(ARCSLIP_BATCH)
# arcslip_batch(TARGET NAME source...): these sources of the target, in batches of about the same size.
function(arcslip_batch target name)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${ARCSLIP_UNITY} UNITY_BUILD_MODE GROUP)
  set(all 0)
  foreach(source IN LISTS ARGN)
    file(SIZE ${source} bytes)
    math(EXPR all "${all} + ${bytes}")
  endforeach()
  math(EXPR batches "${all} / ${ARCSLIP_BATCH} + 1")
  set(before 0)
  foreach(source IN LISTS ARGN)
    math(EXPR batch "${before} * ${batches} / (${all} + 1)")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${name}_${batch})
    file(SIZE ${source} bytes)
    math(EXPR before "${before} + ${bytes}")
  endforeach()
endfunction()

# arcslip_library(NAME ROOMS room... [LIGHT room, folder or file...] FILES file... [PUBLIC library...] [PRIVATE library...])
# makes arcslip_NAME (arcslip::NAME). ROOMS are pairs "link=folder": the folder is seen as <arcslip/link/...>.
# FILES begin with the link. The headers among them are public and get installed, as is NAME.hpp next to the CMakeLists.txt,
# the library's umbrella <arcslip/NAME.hpp>; a header that is not listed is private. PUBLIC and PRIVATE are what it is linked to.
# LIGHT is what computes nothing in loops, which is compiled with -O1 in a third of the time.
# Each library has a root of links of its own, so that an include of a library that is not linked does not compile.
function(arcslip_library name)
  cmake_parse_arguments(arg "" "" "ROOMS;LIGHT;FILES;PUBLIC;PRIVATE" ${ARGN})
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
  set(links "")
  foreach(file IN LISTS arg_FILES)
    string(REGEX MATCH "^[^/]+" link ${file})
    if(NOT DEFINED folder_of_${link})
      message(FATAL_ERROR "${file} of library ${name} is in none of its rooms: ${arg_ROOMS}")
    elseif(file MATCHES "\\.hpp$")
      list(APPEND headers ${root}/arcslip/${file})
    else()
      string(REGEX REPLACE "^[^/]+" "${folder_of_${link}}" path ${file})
      string(REGEX REPLACE "/[^/]+$" "" folder ${file})
      list(APPEND links ${link})
      if(link IN_LIST arg_LIGHT OR folder IN_LIST arg_LIGHT OR file IN_LIST arg_LIGHT)
        list(APPEND light_${link} ${path})
      else()
        list(APPEND heavy_${link} ${path})
      endif()
    endif()
  endforeach()
  list(REMOVE_DUPLICATES links)
  add_library(${target})
  add_library(arcslip::${name} ALIAS ${target})
  add_library(${target}_light OBJECT)
  foreach(link IN LISTS links)
    target_sources(${target} PRIVATE ${heavy_${link}})
    target_sources(${target}_light PRIVATE ${light_${link}})
    arcslip_batch(${target} ${link} ${heavy_${link}})
    arcslip_batch(${target}_light ${link} ${light_${link}})
  endforeach()
  # Nothing asks for the macro that CMake defines in a shared library, and precompiled headers serve several.
  set_target_properties(${target} PROPERTIES DEFINE_SYMBOL "" EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${root} FILES ${headers})
  arcslip_compile_options(${target})
  target_compile_options(${target} PRIVATE ${arcslip_heavy})
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  target_precompile_headers(${target} REUSE_FROM arcslip_headers)
  set_target_properties(${target}_light PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target}_light PRIVATE ${root})
  arcslip_compile_options(${target}_light)
  target_compile_options(${target}_light PRIVATE ${arcslip_light})
  target_link_libraries(${target}_light PRIVATE ${arg_PUBLIC} ${arg_PRIVATE})
  target_precompile_headers(${target}_light REUSE_FROM arcslip_headers_light)
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_light>)
  install(TARGETS ${target} EXPORT arcslip
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()
