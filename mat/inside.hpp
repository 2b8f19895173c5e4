#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace arcslip::mat {

/// Looks through a file of version 7.3, before matio follows its links. Throws Fault where it refers to what
/// is not in it: links to other files, data in other files, data of filters that are not part of HDF5.
/// Returns of each variable that is sparse how many numbers the longest of its arrays has.
std::map<std::string, std::size_t> look_through(const char* path);

}  // namespace arcslip::mat
