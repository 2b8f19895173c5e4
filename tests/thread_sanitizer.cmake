# The libraries once more, with the thread sanitizer in place of the others.

# arcslip_with_thread_sanitizer(NAME LINK library...) makes arcslip_NAME_threads of the sources of arcslip_NAME.
function(arcslip_with_thread_sanitizer name)
  cmake_parse_arguments(arg "" "" "LINK" ${ARGN})
  set(target arcslip_${name}_threads)
  set(sources "")
  foreach(part arcslip_${name} arcslip_${name}_heavy)
    if(TARGET ${part})
      get_target_property(of_part ${part} SOURCES)
      list(APPEND sources ${of_part})
    endif()
  endforeach()
  list(FILTER sources INCLUDE REGEX "^[^<>]*\\.cpp$")
  add_library(${target} STATIC EXCLUDE_FROM_ALL ${sources})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${ARCSLIP_UNITY} UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS sources)  # names at file level are unique in a room, in continuation and in optimize
    string(REGEX REPLACE "^.*/lib/([^/]+)/.*" "\\1" group ${source})
    if(group STREQUAL source)
      set(group ${name})
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  target_include_directories(${target} PUBLIC $<TARGET_PROPERTY:arcslip_${name},INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(${target} PUBLIC Eigen3::Eigen ${arg_LINK} PRIVATE nlohmann_json::nlohmann_json)
  arcslip_compile_options(${target})
  target_compile_options(${target} PUBLIC -fsanitize=thread -O1
    PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overread;-Wno-maybe-uninitialized>)  # false alarms, as in ArcslipFlags.cmake
  target_precompile_headers(${target} PRIVATE ${arcslip_common_headers})
  target_link_options(${target} PUBLIC -fsanitize=thread)
endfunction()
