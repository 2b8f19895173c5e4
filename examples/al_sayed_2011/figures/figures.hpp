#pragma once
// The figures of Al Sayed et al. (2011), each group from its own scene.

#include "data_file.hpp"

#include <string>
#include <vector>

namespace figures {

/// Figs. 3, 4, 5 and 7, of contact.scene.json.
std::vector<DataFile> contact(const std::string& scenes);
/// Fig. 6, of scene.json.
std::vector<DataFile> responses(const std::string& scenes);
/// Figs. 8 to 13, of energies.scene.json.
std::vector<DataFile> energies(const std::string& scenes);
/// Figs. 14 to 19, of components.scene.json.
std::vector<DataFile> components(const std::string& scenes);

}  // namespace figures
