#include <arcslip/scene/named_file.hpp>
#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/study_type.hpp>

#include <filesystem>

namespace arcslip::scene {

std::vector<NamedFile*> files(Scene& scene) {
  std::vector<NamedFile*> all;
  const auto add = [&](const auto* type, Settings& settings) {
    if (type == nullptr) {
      return;
    }
    const auto found = type->files(settings);
    all.insert(all.end(), found.begin(), found.end());
  };
  for (Part& part : scene.elements) {
    add(part.type, part.options);
  }
  for (Study& study : scene.studies) {
    add(study.type, study.settings);
  }
  return all;
}

Scene from_folder(Scene scene, const std::string& folder) {
  for (NamedFile* file : files(scene)) {
    const std::filesystem::path path = file->path;
    if (path.is_relative()) {
      file->path = std::filesystem::proximate(std::filesystem::path(scene.folder.path) / path, folder)
                       .generic_string();
    }
  }
  scene.folder.path = folder;
  return scene;
}

}  // namespace arcslip::scene
