#include <arcslip/scene/files/helper_program.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <dlfcn.h>
#include <unistd.h>

namespace arcslip::scene::detail {
namespace {

namespace fs = std::filesystem;

bool is_program(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0;
}

fs::path folder_of_program() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

// Of this code: empty where it is part of the program.
fs::path folder_of_library() {
  Dl_info found{};
  if (::dladdr(reinterpret_cast<const void*>(&find_own_program), &found) == 0) return {};
  const fs::path path = found.dli_fname == nullptr ? "" : found.dli_fname;
  if (path.is_relative())
    return {};  // the word by which the program was started: not from the current folder
  std::error_code error;
  return fs::canonical(path, error).parent_path();
}

void add_around(const fs::path& folder, int levels, std::vector<fs::path>& all) {
  if (folder.empty()) return;
  all.push_back(folder);
  fs::path above = folder;
  for (int k = 0; k < levels; ++k) {
    above = above.parent_path();
    all.push_back(above / "libexec" / "arcslip");
    all.push_back(above / "bin");
  }
}

std::vector<fs::path> folders_of_path() {
  std::vector<fs::path> all;
  const char* set = std::getenv("PATH");
  for (std::string_view rest = set == nullptr ? "" : set; !rest.empty();) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    const fs::path folder = rest.substr(0, end);
    if (folder.is_absolute()) all.push_back(folder);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return all;
}

}  // namespace

OwnProgram find_own_program(const std::string& name, const char* variable) {
  OwnProgram found;
  if (const char* given = std::getenv(variable); given != nullptr && *given != '\0') {
    found.path = given;
    return found;
  }
  std::vector<fs::path> folders;
  add_around(folder_of_program(), 1, folders);
  add_around(folder_of_library(), 2, folders);
  for (const fs::path& folder : folders)
    if (std::find(found.folders.begin(), found.folders.end(), folder) == found.folders.end())
      found.folders.push_back(folder.string());
  const std::vector<fs::path> further = folders_of_path();
  folders.insert(folders.end(), further.begin(), further.end());
  const auto here = std::find_if(folders.begin(), folders.end(),
                                 [&](const fs::path& folder) { return is_program(folder / name); });
  if (here != folders.end()) found.path = (*here / name).string();
  return found;
}

}  // namespace arcslip::scene::detail
