#include <arcslip/model/reduced_scene.hpp>

#include <arcslip/control/run_control.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/model/placed_matrices.hpp>
#include <arcslip/model/reduction_report.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/scene/shape.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace arcslip::model {
namespace {

constexpr double rounding = 1e-9;          // a negative entry of the diagonal, relative to its row
constexpr double finest_accuracy = 1e-11;  // of what is reduced again where it is read
constexpr int largest_whole = 500;         // rows of matrices without a highest frequency

// A comment, then the entries other than 0; of a symmetric and of a skew-symmetric matrix the lower triangle.
std::string matrix_market(const Eigen::MatrixXd& A, MatrixForm form, const std::string& comment) {
  using enum MatrixForm;
  const Eigen::Index n = A.rows();
  std::string lines;
  std::size_t count = 0;
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = form == general ? 0 : form == symmetric ? j : j + 1; i < n; ++i) {
      if (A(i, j) == 0) continue;
      ++count;
      lines += std::to_string(i + 1) + ' ' + std::to_string(j + 1) + ' ';
      results::append_shortest(lines, A(i, j));
      lines += '\n';
    }
  const char* name = form == symmetric ? "symmetric" : form == skew ? "skew-symmetric" : "general";
  return std::string("%%MatrixMarket matrix coordinate real ") + name + "\n% " + comment + '\n' +
         std::to_string(n) + ' ' + std::to_string(n) + ' ' + std::to_string(count) + '\n' + lines;
}

std::string vector_market(const Eigen::VectorXd& f) {
  std::string text = "%%MatrixMarket matrix array real general\n" + std::to_string(f.size()) + " 1\n";
  for (const double value : f) {
    results::append_shortest(text, value);
    text += '\n';
  }
  return text;
}

// Without entries on the diagonal of K that rounding makes negative, as where a structure floats.
Eigen::MatrixXd semidefinite(Eigen::MatrixXd K, const Eigen::MatrixXd& M, double highest) {
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    const double size = K.row(i).cwiseAbs().maxCoeff() + highest * highest * std::abs(M(i, i));
    if (K(i, i) < 0 && -K(i, i) <= rounding * size) K(i, i) = 0;
  }
  return K;
}

// A name that a table of names holds as it is.
const std::string& plain_name(const std::string& name) {
  if (name.find_first_of(",\"\r\n") != std::string::npos || name.front() == '#' ||
      name.find_first_of(" \t") == 0 || name.find_last_of(" \t") == name.size() - 1)
    throw NotReduced(
        "the degree of freedom " + results::json_quoted(name) +
        " has a name that names.csv cannot hold: use one without commas, quotes and line breaks, "
        "without white space at its ends, and without a leading #");
  return name;
}

// The blocks of the matrices of the structure in the rows and coordinates of its reduction.
class Blocks {
 public:
  explicit Blocks(const Model& model) : model_(model) {}
  Eigen::MatrixXd next() {
    return model_.matrices[next_++].A->topLeftCorner(model_.unnamed_to, model_.unnamed_to);
  }

 private:
  const Model& model_;
  std::size_t next_ = 0;
};

// Throws NotReduced where the scene has no reduction of its own.
void check_reduced(const scene::Scene& scene) {
  if (!scene.matrices || scene.matrices->highest_frequency == 0)
    throw NotReduced(
        "the structure is not reduced: give its matrices, its beam or its rod a \"highest_frequency\"");
  if (scene.matrices->copies > 1)
    throw NotReduced("the structure stands in " + std::to_string(scene.matrices->copies) +
                     " copies: reduce one of them, without \"copies\", or one sector of a full ring, without "
                     "\"full\": true, which may then stand in the reduced scene");
  if (!scene.matrices->faces.empty())
    throw NotReduced(
        "the sector has \"faces\" to the next one: it is reduced for each nodal diameter of a scene, not "
        "once for all");
  for (const scene::Part& part : scene.excitation)
    if (scene::is_base_motion(*part.type) && scene::shape_of(part) != nullptr)
      throw NotReduced(
          "the ground moves under all rows by the excitation \"" + part.name +
          "\", which has no displacements of the coordinates of a reduced structure: give M r as "
          "the shape of a force");
}

// The files of the reduced structure of a model, and their places in a scene.
class ReducedFiles {
 public:
  ReducedFiles(const Model& model, const scene::Scene& scene) : model_(model) {
    const scene::Matrices& matrices = *scene.matrices;
    comment_ = "reduced from " + std::to_string(model.reduction->rows) + " rows, for frequencies up to ";
    results::append_shortest(comment_, matrices.highest_frequency);
    comment_ += " " + std::string(scene::unit_name(scene.frequency_unit)) + ", error ";
    results::append_shortest(comment_, model.reduction->error);
  }

  void add_matrices(const scene::Matrices& from, scene::Matrices& to) {
    const auto form = [](bool unsymmetric) {
      return unsymmetric ? MatrixForm::general : MatrixForm::symmetric;
    };
    Blocks blocks(model_);
    const Eigen::MatrixXd M = blocks.next();
    to.mass = matrix("M.mtx", M, MatrixForm::symmetric);
    to.stiffness = matrix("K.mtx", semidefinite(blocks.next(), M, model_.reduction->highest_frequency),
                          form(from.unsymmetric_stiffness));
    if (from.damping.matrix) to.damping = matrix("C.mtx", blocks.next(), form(from.unsymmetric_damping));
    if (from.stiffness_speed_squared.matrix)
      to.stiffness_speed_squared = matrix("K2.mtx", blocks.next(), MatrixForm::symmetric);
    if (from.gyroscopic.matrix) to.gyroscopic = matrix("G.mtx", blocks.next(), MatrixForm::skew);
    if (from.circulatory.matrix) to.circulatory = matrix("N.mtx", blocks.next(), MatrixForm::skew);
    std::string names = "name,row\n";
    for (int i = 0; i < model_.unnamed_from; ++i)
      names += plain_name(model_.dof_names[static_cast<std::size_t>(i)]) + ',' + std::to_string(i + 1) + '\n';
    to.names = add("names.csv", names);
    to.bar.reset();
    to.reduction = {};
    if (model_.unnamed_to <= largest_whole)
      to.highest_frequency = 0;
    else
      to.reduction.accuracy = finest_accuracy;
  }

  void add_shapes(std::vector<scene::Part>& excitation) {
    std::size_t next = 0;  // of the model's excitations, one for each part of a shape
    for (std::size_t i = 0; i < excitation.size(); ++i) {
      if (scene::shape_of(excitation[i]) == nullptr) {
        ++next;
        continue;
      }
      auto& shape = excitation[i].options.as<scene::Shape>();
      for (scene::ShapeFile* file : {&shape.real, &shape.imaginary}) {
        if (!file->is_given()) continue;
        const std::string name =
            "shape_" + std::to_string(i + 1) + (file == &shape.imaginary ? "_imaginary.mtx" : ".mtx");
        const auto load = model_.excitation[next++].load.head(model_.unnamed_to);
        *file = {{add(name, vector_market(load)), nullptr, {}}, 1};
      }
    }
  }

  auto take() { return std::move(files_); }

 private:
  scene::NamedFile add(const std::string& name, std::string content) {
    files_.emplace_back(name, std::move(content));
    return {name, std::make_shared<const std::string>(files_.back().second)};
  }
  scene::MatrixFile matrix(const std::string& name, const Eigen::MatrixXd& A, MatrixForm form) {
    return {add(name, matrix_market(A, form, comment_)), nullptr, {}};
  }

  const Model& model_;
  std::string comment_;
  std::vector<std::pair<std::string, std::string>> files_;
};

// 0 stands for the highest frequency.
std::vector<scene::ErrorOfReduction> errors_of_reduction(const scene::Scene& scene,
                                                         std::vector<double> frequencies,
                                                         const control::Control& control) {
  frequencies.push_back(0);
  std::vector<scene::ErrorOfReduction> all;
  for (const double frequency : frequencies)
    all.push_back(*observables::error_of_reduction(scene, frequency, control));
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  const auto same = [](const auto& a, const auto& b) { return a.frequency == b.frequency; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

}  // namespace

ReducedScene reduced_scene(const scene::Scene& scene, const std::string& folder,
                           const control::Control& control, std::vector<double> frequencies) {
  check_reduced(scene);
  scene::Scene undamped = scene;  // of the damping that the scene adds
  undamped.damping.clear();
  const Model model = build(undamped, control);
  scene::Scene copy = scene::from_folder(scene, folder);
  copy.matrices->errors = errors_of_reduction(scene, std::move(frequencies), control);
  ReducedFiles files(model, scene);
  files.add_matrices(*scene.matrices, *copy.matrices);
  files.add_shapes(copy.excitation);
  return {scene::write(copy), files.take()};
}

}  // namespace arcslip::model
