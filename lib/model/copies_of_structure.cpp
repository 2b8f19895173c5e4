// Copies of one structure.

#include <arcslip/model/matrix_placement.hpp>

#include <map>

namespace arcslip::model {

using Eigen::MatrixXd;
namespace {

scene::Matrices with_stiffness(scene::Matrices matrices, double factor) {
  if (factor == 1) return matrices;
  scene::SparseMatrix K = *matrices.stiffness.matrix;
  for (double& value : K.values) value *= factor;
  matrices.stiffness.matrix = std::make_shared<const scene::SparseMatrix>(std::move(K));
  return matrices;
}

}  // namespace

void CopiesOfStructure::make() {
  std::map<double, std::shared_ptr<const Reduced>> made;
  std::vector<Index> sizes;
  for (int copy = 0; copy < copies_; ++copy) {
    const double factor = files_.stiffness_factor(copy);
    std::shared_ptr<const Reduced>& in = made[factor];
    if (!in) in = reduces_ ? reduced(factor) : whole(factor);
    in_.push_back(in);
    sizes.push_back(in->M.rows());
  }
  set_copies(sizes);
  for (const auto& [factor, in] : made) tell_error(in->M.rows(), in->error, in->free_below);
}

std::shared_ptr<const Reduced> CopiesOfStructure::reduced(double factor) const {
  std::vector<std::size_t> all(loads_.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
  auto [purpose_of, key] = purpose(all);
  if (factor != 1) key += fingerprint("of stiffness ", &factor, 1);
  return files_.derived->get<Reduced>(
      key, [&] { return structure::reduce(with_stiffness(files_, factor), rows_, purpose_of, control_); });
}

std::shared_ptr<const Reduced> CopiesOfStructure::whole(double factor) const {
  std::vector<Index> at(rows_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k)
    at[static_cast<std::size_t>(rows_[k])] = static_cast<Index>(k);
  const auto dense = [&](const scene::MatrixFile& file, MatrixForm form) {
    if (!file.matrix) return MatrixXd();
    const scene::SparseMatrix& of = *file.matrix;
    MatrixXd A = MatrixXd::Zero(of.rows, of.columns);
    for (std::size_t j = 0; j < at.size(); ++j)
      for (auto k = static_cast<std::size_t>(of.starts[j]); k < static_cast<std::size_t>(of.starts[j + 1]);
           ++k)
        A(at[static_cast<std::size_t>(of.row_of[k])], at[j]) = of.values[k];
    if (form == MatrixForm::symmetric) A = 0.5 * (A + A.transpose()).eval();
    if (form == MatrixForm::skew) A = 0.5 * (A - A.transpose()).eval();
    return A;
  };
  const auto form = [](bool unsymmetric) {
    return unsymmetric ? MatrixForm::general : MatrixForm::symmetric;
  };
  Reduced in;
  in.M = dense(files_.mass, MatrixForm::symmetric);
  in.K = factor * dense(files_.stiffness, form(files_.unsymmetric_stiffness));
  in.C = dense(files_.damping, form(files_.unsymmetric_damping));
  in.K2 = dense(files_.stiffness_speed_squared, MatrixForm::symmetric);
  in.G = dense(files_.gyroscopic, MatrixForm::skew);
  in.N = dense(files_.circulatory, MatrixForm::skew);
  in.loads.resize(files_.size(), static_cast<Index>(loads_.size()));
  for (std::size_t k = 0; k < loads_.size(); ++k) in.loads.col(static_cast<Index>(k)) = loads_[k].load(rows_);
  return std::make_shared<const Reduced>(std::move(in));
}

bool CopiesOfStructure::add(LinearKind kind, const Which& which) {
  if (((*in_.front()).*which.of_copy).size() == 0) return false;
  const auto dofs = static_cast<Index>(placed_.dof_names.size());
  MatrixXd A = MatrixXd::Zero(dofs, dofs);
  for (int copy = 0; copy < copies_; ++copy) {
    const MatrixXd& block = (*in_[static_cast<std::size_t>(copy)]).*which.of_copy;
    for (Index j = 0; j < block.cols(); ++j)
      for (Index i = 0; i < block.rows(); ++i) A(place_of(copy, i), place_of(copy, j)) = block(i, j);
  }
  placed_.parts.push_back({kind, -1, std::make_shared<const MatrixXd>(std::move(A))});
  return true;
}

void CopiesOfStructure::place_shapes() {
  const auto dofs = static_cast<Index>(placed_.dof_names.size());
  for (std::size_t s = 0; s < placed_.shapes.size(); ++s) {
    PlacedShape& shape = placed_.shapes[s];
    const int copy = copy_of_[s];
    const Load& of = loads_[load_of_[s]];
    const MatrixXd& loads = in_[static_cast<std::size_t>(copy)]->loads;
    shape.load.setZero(dofs);
    for (Index k = 0; k < loads.rows(); ++k)
      shape.load[place_of(copy, k)] = loads(k, static_cast<Index>(load_of_[s]));
    if (!scene::is_base_motion(*scene_.excitation[shape.excitation].type)) continue;
    shape.ground.setZero(dofs);
    for (std::size_t k = 0; k < rows_.size(); ++k)
      shape.ground[place_of(copy, static_cast<Index>(k))] = of.on_rows[rows_[k]];
  }
}

}  // namespace arcslip::model
