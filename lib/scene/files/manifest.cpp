#include <arcslip/results/text.hpp>
#include <arcslip/scene/faults.hpp>
#include <arcslip/scene/files/manifest.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/keys/read_text.hpp>
#include <arcslip/scene/keys/write_values.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <system_error>

namespace arcslip::scene {
namespace {

namespace fs = std::filesystem;
using file::Node;

constexpr const char* format = "arcslip-manifest-1";
constexpr std::size_t largest = std::size_t{64} << 20;  // bytes

const Node* find(const Node& node, std::string_view key) {
  const auto* object = node.get<Node::Object>();
  if (object == nullptr) return nullptr;
  for (const file::Member& member : *object)
    if (member.key == key) return &member.value;
  return nullptr;
}

template <class T>
const T* find(const Node& node, std::string_view key) {
  const Node* found = find(node, key);
  return found != nullptr ? found->get<T>() : nullptr;
}

/// A name of a file in the folder itself: no path out of it.
bool is_plain(const std::string& name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
         name.find('\0') == std::string::npos;
}

std::optional<FileSet> read_set(const Node& node) {
  const auto* name = find<std::string>(node, "name");
  const auto* program = find<std::string>(node, "program");
  const auto* scene_hash = find<std::string>(node, "scene_hash");
  const auto* complete = find<bool>(node, "complete");
  const auto* files = find<Node::Object>(node, "files");
  if (name == nullptr || program == nullptr || scene_hash == nullptr || complete == nullptr ||
      files == nullptr)
    return std::nullopt;
  FileSet set{*name, *program, *scene_hash, *complete, {}};
  for (const file::Member& member : *files) {
    const auto* hash = member.value.get<std::string>();
    if (!is_plain(member.key) || (hash == nullptr && member.value.get<std::nullptr_t>() == nullptr))
      return std::nullopt;
    set.files.push_back({member.key, hash != nullptr ? *hash : ""});
  }
  return set;
}

std::optional<Manifest> read(const Node& node) {
  const auto* name = find<std::string>(node, "format");
  const auto* sets = find<Node::List>(node, "sets");
  if (name == nullptr || *name != format || sets == nullptr) return std::nullopt;
  Manifest manifest;
  for (const Node& each : *sets) {
    std::optional<FileSet> set = read_set(each);
    if (!set) return std::nullopt;
    manifest.sets.push_back(std::move(*set));
  }
  return manifest;
}

std::string folder_of(const fs::path& path) {
  const std::string folder = path.parent_path().string();
  return folder.empty() ? "." : folder;
}

std::string as_text(const FileSet& set) {
  return file::quoted(set.name);
}

}  // namespace

std::string ContentHash::text() const {
  std::string digits(16, '0');
  std::uint64_t rest = state_;
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, rest >>= 4)
    *digit = "0123456789abcdef"[rest & 15];
  return digits;
}

FileSet* Manifest::find(std::string_view set) {
  const auto found =
      std::find_if(sets.begin(), sets.end(), [&](const FileSet& each) { return each.name == set; });
  return found != sets.end() ? &*found : nullptr;
}

std::string Manifest::text() const {
  Node::List list;
  for (const FileSet& set : sets) {
    Node::Object files;
    for (const FileSet::File& each : set.files)
      files.push_back({each.name, each.hash.empty() ? Node{nullptr} : file::node(each.hash)});
    list.push_back({Node::Object{{"name", file::node(set.name)},
                                 {"program", file::node(set.program)},
                                 {"scene_hash", file::node(set.scene_hash)},
                                 {"complete", Node{set.complete}},
                                 {"files", {std::move(files)}}}});
  }
  return file::print_tree(
      {Node::Object{{"format", file::node(std::string(format))}, {"sets", {std::move(list)}}}});
}

Manifest read_manifest(const std::string& folder) {
  const std::string path = (fs::path(folder) / manifest_name).string();
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return {};
  if (fs::is_regular_file(path, error)) {
    const std::string text = file::read_text(path, {}, "manifest", largest);
    try {
      if (std::optional<Manifest> manifest = read(file::read_tree(text))) return std::move(*manifest);
    } catch (const SceneError&) {  // no JSON
    }
  }
  throw FileError(results::visible(path) + " is no manifest of Arcslip, or is damaged: move it away");
}

std::string file_hash(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return "";
  std::ifstream in(path, std::ios::binary);
  ContentHash hash;
  std::string chunk(1 << 16, '\0');
  while (in) {
    in.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    hash.add(std::string_view(chunk).substr(0, static_cast<std::size_t>(in.gcount())));
  }
  return in.eof() ? hash.text() : "";
}

ManifestDoubts manifest_doubts(const Scene& scene, const std::string& file) {
  ManifestDoubts doubts;
  std::map<fs::path, Manifest> known;
  const auto check = [&](const fs::path& path, const std::string* text) {
    const auto [entry, is_new] = known.try_emplace(folder_of(path));
    if (is_new) {
      try {
        entry->second = read_manifest(entry->first.string());
      } catch (const FileError& error) {
        doubts.changed.emplace_back(error.what());
      }
    }
    for (const FileSet& set : entry->second.sets)
      for (const FileSet::File& each : set.files) {
        if (each.name != path.filename()) continue;
        if (!set.complete) {
          doubts.interrupted.push_back(results::visible(path.string()) + " is of the set " + as_text(set) +
                                       " of " + results::visible((entry->first / manifest_name).string()) +
                                       ", whose writing was interrupted: its files may be of two scenes; "
                                       "write them again, or remove the "
                                       "manifest if they belong together");
          continue;
        }
        ContentHash hash;
        if (text != nullptr) hash.add(*text);
        const std::string now = text != nullptr ? hash.text() : file_hash(path.string());
        if (!now.empty() && each.hash != now)
          doubts.changed.push_back(results::visible(path.string()) +
                                   " has changed since it was written with the other " + "files of the set " +
                                   as_text(set) + " of " +
                                   results::visible((entry->first / manifest_name).string()));
      }
  };
  check(file, nullptr);
  Scene copy = scene;
  for (const NamedFile* named : files(copy)) {
    const fs::path path = named->path;
    if (!named->path.empty())
      check(path.is_absolute() ? path : fs::path(scene.folder.path) / path, named->text.get());
  }
  return doubts;
}

}  // namespace arcslip::scene
