# How every library and program of Arcslip is compiled, and where a library finds its headers.

include(ArcslipFlags)

# arcslip_find(NAME PACKAGE [VERSION] ...) finds what the project needs, as find_package(NAME ...); PACKAGE is Debian's.
macro(arcslip_find name package)
  find_package(${name} ${ARGN} QUIET)
  if(NOT ${name}_FOUND)
    string(REGEX MATCH "^[0-9.]+" needed "${ARGN}")
    message(FATAL_ERROR "${name} ${needed} was not found, which Arcslip needs. Debian and Ubuntu have it in the package ${package}.")
  endif()
endmacro()

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
  arcslip_sanitize(${target})
  target_precompile_headers(${target} PRIVATE ${arcslip_common_headers} ${ARGN})
endfunction()

# The sources of a target in batches: one batch is one translation unit, which compiles what its files include, and the
# templates that they instantiate, once. The files of a batch are of one folder of lib, so that names at file level have to
# be unique in it, with the rooms below it, in continuation and in optimize, and not beyond. Where ARCSLIP_UNITY is off, each file is compiled alone.
set(ARCSLIP_HEAVY_BATCH 40000 CACHE STRING "Bytes of source of a batch, about, of what is optimised for speed")
set(ARCSLIP_LIGHT_BATCH 200000 CACHE STRING "The same, of what is not")
mark_as_advanced(ARCSLIP_HEAVY_BATCH ARCSLIP_LIGHT_BATCH)
# arcslip_batch(TARGET NAME BYTES source...): these sources of the target, in batches of about the same size.
function(arcslip_batch target name size)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${ARCSLIP_UNITY} UNITY_BUILD_MODE GROUP)
  set(all 0)
  foreach(source IN LISTS ARGN)
    file(SIZE ${source} bytes)
    math(EXPR all "${all} + ${bytes}")
  endforeach()
  math(EXPR batches "${all} / ${size} + 1")
  set(before 0)
  foreach(source IN LISTS ARGN)
    math(EXPR batch "${before} * ${batches} / (${all} + 1)")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${name}_${batch})
    file(SIZE ${source} bytes)
    math(EXPR before "${before} + ${bytes}")
  endforeach()
endfunction()

# arcslip_library(NAME ROOMS room... [LIGHT room, folder or file...] [HEAVY file...] [ALONE file...] SOURCES file... [PUBLIC library...] [PRIVATE library...])
# makes arcslip_NAME (arcslip::NAME). ROOMS are pairs "link=folder": the folder is seen as <arcslip/link/...>. SOURCES begin
# with the link. NAME.hpp next to the CMakeLists.txt is the library's umbrella <arcslip/NAME.hpp>: it and all that it
# includes, directly or through others, is public and gets installed. PUBLIC and PRIVATE are what the library is linked to.
# LIGHT is what takes little of the time of a run, which is compiled with -O1 in a third of the time, but for the files of
# HEAVY. ALONE is what is in no batch: a file that takes long, and one in whose loops GCC inlines less in a large unit.
# Each library has a root of links of its own, so that an include of a library that is not linked does not compile.
function(arcslip_library name)
  cmake_parse_arguments(arg "" "" "ROOMS;LIGHT;HEAVY;ALONE;SOURCES;PUBLIC;PRIVATE" ${ARGN})
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
  foreach(file IN LISTS arg_SOURCES)
    string(REGEX MATCH "^[^/]+" link ${file})
    if(NOT DEFINED folder_of_${link})
      message(FATAL_ERROR "${file} of library ${name} is in none of its rooms: ${arg_ROOMS}")
    endif()
    string(REGEX REPLACE "^[^/]+" "${folder_of_${link}}" path ${file})
    string(REGEX REPLACE "/[^/]+$" "" folder ${file})
    list(APPEND known ${link} ${folder} ${file})
    set(kind heavy)
    if(NOT file IN_LIST arg_HEAVY AND (link IN_LIST arg_LIGHT OR folder IN_LIST arg_LIGHT OR file IN_LIST arg_LIGHT))
      set(kind light)
    endif()
    if(file IN_LIST arg_ALONE)
      set_source_files_properties(${path} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      list(APPEND ${kind}_alone ${path})
    else()
      list(APPEND ${kind}_links ${link})
      list(APPEND ${kind}_${link} ${path})
    endif()
  endforeach()
  foreach(entry IN LISTS arg_LIGHT arg_HEAVY arg_ALONE)
    if(NOT entry IN_LIST known)
      message(FATAL_ERROR "library ${name} has no file and no room ${entry}")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES light_links)
  list(REMOVE_DUPLICATES heavy_links)
  # Of several copies of an inline function the linker takes the first one: objects of another target come before a target's
  # own, so that what is optimised for speed is that.
  add_library(${target} ${light_alone})
  add_library(arcslip::${name} ALIAS ${target})
  set(targets ${target})
  if(heavy_alone OR heavy_links)
    add_library(${target}_heavy OBJECT ${heavy_alone})
    list(APPEND targets ${target}_heavy)
  endif()
  foreach(link IN LISTS light_links)
    target_sources(${target} PRIVATE ${light_${link}})
    arcslip_batch(${target} ${link} ${ARCSLIP_LIGHT_BATCH} ${light_${link}})
  endforeach()
  foreach(link IN LISTS heavy_links)
    target_sources(${target}_heavy PRIVATE ${heavy_${link}})
    arcslip_batch(${target}_heavy ${link} ${ARCSLIP_HEAVY_BATCH} ${heavy_${link}})
  endforeach()
  foreach(each IN LISTS targets)
    set_target_properties(${each} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    arcslip_compile_options(${each})
    arcslip_sanitize(${each})
    arcslip_harden(${each})
  endforeach()
  # Nothing asks for the macro that CMake defines in a shared library, and precompiled headers serve several.
  set_target_properties(${target} PROPERTIES DEFINE_SYMBOL "" EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${root}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_options(${target} PRIVATE ${arcslip_light})
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  target_precompile_headers(${target} REUSE_FROM arcslip_headers_light)
  if(TARGET ${target}_heavy)
    target_include_directories(${target}_heavy PRIVATE ${root})
    target_compile_options(${target}_heavy PRIVATE ${arcslip_heavy})
    target_link_libraries(${target}_heavy PRIVATE ${arg_PUBLIC} ${arg_PRIVATE})
    target_precompile_headers(${target}_heavy REUSE_FROM arcslip_headers)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_heavy>)
  endif()
  install(TARGETS ${target} EXPORT arcslip
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endfunction()
