#include <arcslip/hbm/linear/matrices_in_waves.hpp>

#include <arcslip/hbm/linear/sparsity_pattern.hpp>

#include <utility>

namespace arcslip::hbm {
namespace {

constexpr double sparse_P = 0.1;  // share of entries that are not zero

// P^T A P. Columns of P with one entry, of which most are where linear coordinates are no modes, add no
// rounding errors between coordinates that A does not link.
template <class Scalar>
Eigen::SparseMatrix<Scalar> product(const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& A,
                                    const Eigen::MatrixXd& P) {
  const Eigen::SparseMatrix<double> few = P.sparseView();
  if (static_cast<double>(few.nonZeros()) > sparse_P * static_cast<double>(P.size())) {
    const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> AP = A * P.cast<Scalar>();
    return (P.cast<Scalar>().transpose() * AP).eval().sparseView();
  }
  const Eigen::SparseMatrix<Scalar> in_x = A.sparseView(), of_y = few.cast<Scalar>();
  const Eigen::SparseMatrix<Scalar> AP = in_x * of_y;
  return of_y.transpose() * AP;
}

}  // namespace

std::vector<ComplexSparse> in_waves(const model::MatrixPart& part, const Eigen::MatrixXd& P,
                                    const std::vector<int>& diameters) {
  const auto is_entry = [](Eigen::Index, Eigen::Index, const Complex& value) { return value != 0.0; };
  std::vector<ComplexSparse> waves;
  if (!part.waves) {
    waves.emplace_back(product(*part.A, P).cast<Complex>()).prune(is_entry);
    return waves;
  }
  SparsityPattern links(P.cols());
  for (const int diameter : diameters) {
    ComplexSparse& A = waves.emplace_back(product(part.waves->of(diameter), P));
    A.prune(is_entry);
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      for (ComplexSparse::InnerIterator entry(A, j); entry; ++entry) links.link(entry.row(), j);
  }
  const ComplexSparse all = links.matrix();
  for (ComplexSparse& A : waves) {
    if (A.nonZeros() == all.nonZeros()) continue;
    ComplexSparse same = all;
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      for (ComplexSparse::InnerIterator entry(A, j); entry; ++entry)
        same.valuePtr()[position(all, entry.row(), j)] = entry.value();
    A = std::move(same);
  }
  return waves;
}

}  // namespace arcslip::hbm
