#pragma once

#include <cstddef>

namespace arcslip::mat {

/// Bounds what the program may take for a file of so many bytes: memory, by what such a file can hold when it
/// is compressed; processor time; no file that it writes; and one open file at a time next to the standard
/// streams. So a file that names others cannot have them opened, and no plugin is loaded.
void limit_resources(std::size_t file);

}  // namespace arcslip::mat
