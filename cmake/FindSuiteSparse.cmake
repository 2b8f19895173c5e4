# SuiteSparse 5.12 ships no CMake configuration. This module finds the two sparse LU solvers of it:
#   SuiteSparse::KLU      (LGPL)
#   SuiteSparse::UMFPACK  (GPL), if present
# and sets SuiteSparse_FOUND and SuiteSparse_VERSION. Components: KLU, which is always needed, and UMFPACK.

find_path(SuiteSparse_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse)
find_library(SuiteSparse_KLU_LIBRARY klu)
find_path(SuiteSparse_UMFPACK_INCLUDE_DIR umfpack.h PATH_SUFFIXES suitesparse)
find_library(SuiteSparse_UMFPACK_LIBRARY umfpack)
mark_as_advanced(SuiteSparse_INCLUDE_DIR SuiteSparse_KLU_LIBRARY
                 SuiteSparse_UMFPACK_INCLUDE_DIR SuiteSparse_UMFPACK_LIBRARY)
set(SuiteSparse_KLU_FOUND FALSE)
if(SuiteSparse_INCLUDE_DIR AND SuiteSparse_KLU_LIBRARY)
  set(SuiteSparse_KLU_FOUND TRUE)
endif()
set(SuiteSparse_UMFPACK_FOUND FALSE)
if(SuiteSparse_UMFPACK_INCLUDE_DIR AND SuiteSparse_UMFPACK_LIBRARY)
  set(SuiteSparse_UMFPACK_FOUND TRUE)
endif()

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
  REQUIRED_VARS SuiteSparse_KLU_LIBRARY SuiteSparse_INCLUDE_DIR
  VERSION_VAR SuiteSparse_VERSION
  HANDLE_COMPONENTS)

if(SuiteSparse_FOUND)
  foreach(solver KLU UMFPACK)
    if(SuiteSparse_${solver}_FOUND AND NOT TARGET SuiteSparse::${solver})
      add_library(SuiteSparse::${solver} UNKNOWN IMPORTED)
      set_target_properties(SuiteSparse::${solver} PROPERTIES
        IMPORTED_LOCATION ${SuiteSparse_${solver}_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${SuiteSparse_INCLUDE_DIR})
    endif()
  endforeach()
endif()
