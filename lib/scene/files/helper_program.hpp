#pragma once
// Programs of Arcslip's own that do a part of its work, such as arcslip-mat.

#include <string>
#include <vector>

namespace arcslip::scene::detail {

struct OwnProgram {
  std::string path;                  // empty: not found
  std::vector<std::string> folders;  // where it was looked for, but for those of PATH
};

/// Takes the path that a variable of the environment gives; where that is not set, looks next to the running
/// program, in ../libexec/arcslip and ../bin from there, in the same places from the shared library
/// (and from the folder above, as of lib/x86_64-linux-gnu), and in the absolute folders of PATH.
OwnProgram find_own_program(const std::string& name, const char* variable);

}  // namespace arcslip::scene::detail
