#pragma once
// Folders and programs that tests use. ctest names them in the environment; a test that is started by hand
// from the repository's root needs no ARCSLIP_SOURCE_DIR.

#include <cstdlib>
#include <stdexcept>
#include <string>

/// The root of the repository.
inline std::string source_folder() {
  const char* folder = std::getenv("ARCSLIP_SOURCE_DIR");
  return folder ? folder : ".";
}

/// The program that a variable of the environment names.
inline std::string program_named(const char* variable) {
  const char* program = std::getenv(variable);
  if (!program) throw std::runtime_error(std::string(variable) + " names no program: run the test by ctest");
  return program;
}
