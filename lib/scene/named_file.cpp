#include <arcslip/scene/named_file.hpp>
#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/scene/study_type.hpp>

#include <filesystem>
#include <system_error>

namespace arcslip::scene {

std::shared_ptr<Derived> Derived::none() {
  return std::make_shared<Derived>();
}

bool operator==(const MatrixFile& a, const MatrixFile& b) {
  return a.file == b.file && a.variable == b.variable;
}

bool operator==(const Matrices& a, const Matrices& b) {
  return a.mass == b.mass && a.stiffness == b.stiffness && a.damping == b.damping &&
         a.stiffness_speed_squared == b.stiffness_speed_squared && a.gyroscopic == b.gyroscopic &&
         a.circulatory == b.circulatory && a.unsymmetric_stiffness == b.unsymmetric_stiffness &&
         a.unsymmetric_damping == b.unsymmetric_damping && a.names == b.names && a.rows == b.rows &&
         a.faces_file == b.faces_file && a.faces == b.faces && a.copies == b.copies &&
         a.stiffness_factors == b.stiffness_factors && a.highest_frequency == b.highest_frequency &&
         a.reduction == b.reduction && a.errors == b.errors && a.bar == b.bar;
}

std::vector<NamedFile*> files(Scene& scene) {
  std::vector<NamedFile*> all;
  const auto add = [&](const auto* type, Settings& settings) {
    if (type == nullptr) return;
    const auto found = type->files(settings);
    all.insert(all.end(), found.begin(), found.end());
  };
  if (scene.matrices && !scene.matrices->bar) {
    Matrices& own = *scene.matrices;
    all = {&own.stiffness.file, &own.mass.file, &own.names};
    for (MatrixFile* file : {&own.damping, &own.stiffness_speed_squared, &own.gyroscopic, &own.circulatory})
      if (!file->file.path.empty()) all.push_back(&file->file);
    if (!own.faces_file.path.empty()) all.push_back(&own.faces_file);
  }
  for (Part& part : scene.elements) add(part.type, part.options);
  for (Part& patch : scene.patches) add(patch.type, patch.options);
  for (Part& part : scene.excitation) add(part.type, part.options);
  for (Study& study : scene.studies) {
    if (study.type != nullptr) add(&study.type->settings(), study.settings);
    if (study.rows_file.text) all.push_back(&study.rows_file);
  }
  return all;
}

Scene from_folder(Scene scene, const std::string& folder) {
  namespace fs = std::filesystem;
  const auto absolute = [](const fs::path& path) {
    std::error_code error;  // where there is no current directory
    const fs::path found = fs::absolute(path.empty() ? "." : path, error);
    return (error ? path : found).lexically_normal();
  };
  const fs::path before = absolute(scene.folder.path), after = absolute(folder);
  for (NamedFile* file : files(scene)) {
    const fs::path path = file->path;
    if (path.is_relative())
      file->path = (before / path).lexically_normal().lexically_proximate(after).generic_string();
  }
  scene.folder.path = folder;
  return scene;
}

}  // namespace arcslip::scene
