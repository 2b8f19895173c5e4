# The options of the compiler and the linker.

option(ARCSLIP_UNITY "Compile several files of a room as one: half the time of a whole build, more for a single change" ON)
option(ARCSLIP_SANITIZE "Build with address and undefined-behaviour sanitizers" OFF)
option(ARCSLIP_HARDENING "Guards against overruns of buffers in optimised builds" ON)

# For what takes little of the time of a run. At -O1 GCC takes values of std::optional for uninitialized.
set(arcslip_light $<$<CONFIG:Release>:-O1>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND arcslip_light $<$<CONFIG:Release>:-Wno-maybe-uninitialized>)
endif()

# The rest: under the sanitizers, too, it is optimised, which takes half more to compile and up to a third less to run.
set(arcslip_heavy "")
if(ARCSLIP_SANITIZE)
  set(arcslip_heavy -O1)
endif()

# GCC looks for memory that it no longer needs from 128 MB on, which takes a tenth of its time: from 1 GB on where there is
# enough for as many compilers as processors.
if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  cmake_host_system_information(RESULT memory QUERY TOTAL_PHYSICAL_MEMORY)  # in MB
  cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)
  math(EXPR memory "${memory} / ${processors}")
  if(memory GREATER 3000)
    add_compile_options(--param=ggc-min-heapsize=1000000)
  endif()
endif()

if(PROJECT_IS_TOP_LEVEL)
  # Paths in messages and assertions are relative to the source: two builds of one tree in two folders are the same.
  add_compile_options(-ffile-prefix-map=${PROJECT_BINARY_DIR}/= -ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
  set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
endif()

# Where ccache is there, objects are kept from build to build, and serve builds of the same tree in other folders: paths below
# the source are hashed as relative ones. With precompiled headers it needs to be set so.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  find_program(ARCSLIP_CCACHE ccache)
  mark_as_advanced(ARCSLIP_CCACHE)
  if(ARCSLIP_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=true ${ARCSLIP_CCACHE})
    add_compile_options(-fpch-preprocess)
  endif()
endif()

# A linker that takes a fraction of the time of the default one, where it is there.
if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  find_program(ARCSLIP_LINKER NAMES mold ld.lld)
  mark_as_advanced(ARCSLIP_LINKER)
  if(ARCSLIP_LINKER MATCHES "mold$")
    add_link_options(-fuse-ld=mold)
  elseif(ARCSLIP_LINKER MATCHES "lld$")
    add_link_options(-fuse-ld=lld)
  endif()
endif()

function(arcslip_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # No fused multiply-add that the source does not ask for: the same digits on every processor.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms of GCC 12 on "text" + std::string: https://gcc.gnu.org/bugzilla/show_bug.cgi?id=105651
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # as in arcslip_light: the preset dev compiles with -O1
    target_compile_options(${target} PRIVATE $<$<CONFIG:Debug>:-Wno-maybe-uninitialized>)
  endif()
endfunction()

# What is installed, in release.
function(arcslip_harden target)
  if(ARCSLIP_HARDENING AND NOT ARCSLIP_SANITIZE)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-fstack-protector-strong;-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>)
    target_link_options(${target} PRIVATE $<$<CONFIG:Release>:LINKER:-z,relro,-z,now>)
  endif()
endfunction()

# Of a library; what links it is compiled alike.
function(arcslip_sanitize target)
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
