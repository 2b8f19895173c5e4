# SuiteSparse 5.12 ships no CMake configuration. This module finds its sparse LU solver, SuiteSparse::KLU,
# and its sparse Cholesky solver, SuiteSparse::CHOLMOD, and sets
# SuiteSparse_FOUND and SuiteSparse_VERSION.

find_path(SuiteSparse_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse)
find_library(SuiteSparse_KLU_LIBRARY klu)
find_library(SuiteSparse_CHOLMOD_LIBRARY cholmod)
mark_as_advanced(SuiteSparse_INCLUDE_DIR SuiteSparse_KLU_LIBRARY SuiteSparse_CHOLMOD_LIBRARY)

set(SuiteSparse_VERSION "")
if(SuiteSparse_INCLUDE_DIR AND EXISTS ${SuiteSparse_INCLUDE_DIR}/SuiteSparse_config.h)
  file(STRINGS ${SuiteSparse_INCLUDE_DIR}/SuiteSparse_config.h version_lines
       REGEX "#define SUITESPARSE_(MAIN|SUB|SUBSUB)_VERSION +[0-9]+")
  foreach(line IN LISTS version_lines)
    string(REGEX MATCH "[0-9]+$" number ${line})
    list(APPEND version_numbers ${number})
  endforeach()
  list(JOIN version_numbers "." SuiteSparse_VERSION)
  unset(version_numbers)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse
  REQUIRED_VARS SuiteSparse_KLU_LIBRARY SuiteSparse_CHOLMOD_LIBRARY SuiteSparse_INCLUDE_DIR
  VERSION_VAR SuiteSparse_VERSION)

foreach(solver KLU CHOLMOD)
  if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::${solver})
    add_library(SuiteSparse::${solver} UNKNOWN IMPORTED)
    set_target_properties(SuiteSparse::${solver} PROPERTIES
      IMPORTED_LOCATION ${SuiteSparse_${solver}_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${SuiteSparse_INCLUDE_DIR})
  endif()
endforeach()
