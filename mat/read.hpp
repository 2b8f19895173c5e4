#pragma once

#include <cstddef>
#include <string>

namespace arcslip::mat {

/// Reads a matrix and writes the answer. path: of a file of so many bytes. variable: its name; "": the only
/// one in the file. Throws Fault.
void read(const char* path, std::size_t bytes, const std::string& variable);

}  // namespace arcslip::mat
