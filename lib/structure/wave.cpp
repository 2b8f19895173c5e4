#include <arcslip/structure/wave.hpp>

#include <cmath>
#include <cstddef>
#include <memory>

namespace arcslip::structure {
namespace {

using Complex = std::complex<double>;
using Eigen::Index, Eigen::MatrixXcd, Eigen::MatrixXd;

// A sector in a wave, entry by entry.
class InWave {
 public:
  InWave(const scene::Matrices& sector, const Wave& wave) : rows_(shared_rows(sector)), t_(wave.turn()) {}

  int size() const { return rows_.count; }
  int place(int row) const { return rows_.place[static_cast<std::size_t>(row)]; }
  bool is_beyond(int row) const { return rows_.beyond[static_cast<std::size_t>(row)]; }

  /// entry(i, j, value) of T^H A T, several times for some places.
  template <class Entry>
  void for_each(const scene::SparseMatrix& A, const Entry& entry) const {
    for (int j = 0; j < A.columns; ++j)
      for (auto k = static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j)]);
           k < static_cast<std::size_t>(A.starts[static_cast<std::size_t>(j) + 1]); ++k) {
        const int i = A.row_of[k];
        const Complex turn = is_beyond(i) == is_beyond(j) ? 1 : is_beyond(j) ? t_ : std::conj(t_);
        entry(place(i), place(j), turn * A.values[k]);
      }
  }
  /// T^H f
  MatrixXcd loads(const MatrixXd& f) const {
    MatrixXcd in_wave = MatrixXcd::Zero(size(), f.cols());
    for (Index row = 0; row < f.rows(); ++row) {
      const int at = static_cast<int>(row);
      in_wave.row(place(at)) += (is_beyond(at) ? std::conj(t_) : Complex(1)) * f.row(row);
    }
    return in_wave;
  }

 private:
  const SharedRows rows_;
  const Complex t_;
};

// D of each matrix.
scene::Matrices doubled(const scene::Matrices& sector, const InWave& wave) {
  scene::Matrices twice = sector;
  const int n = wave.size();
  for (scene::MatrixFile* file : {&twice.mass, &twice.stiffness, &twice.damping,
                                  &twice.stiffness_speed_squared, &twice.gyroscopic, &twice.circulatory}) {
    if (!file->matrix) continue;
    std::vector<scene::MatrixEntry> entries;
    wave.for_each(*file->matrix, [&](int i, int j, Complex value) {
      entries.push_back({i, j, value.real()});
      entries.push_back({n + i, n + j, value.real()});
      if (value.imag() == 0) return;
      entries.push_back({n + i, j, value.imag()});
      entries.push_back({i, n + j, -value.imag()});
    });
    file->matrix = std::make_shared<const scene::SparseMatrix>(scene::sparse_matrix(2 * n, 2 * n, entries));
  }
  twice.faces.clear();
  twice.rows.clear();
  return twice;
}

// (U q, z) of b rows that are kept twice.
MatrixXcd half(const MatrixXd& A, Index b) {
  if (A.size() == 0) return {};
  const Index z = A.rows() - 2 * b;
  const Complex i(0, 1);
  MatrixXcd half(b + z, A.cols());
  half.topRows(b) = std::sqrt(0.5) * (A.topRows(b) + i * A.middleRows(b, b));
  half.bottomRows(z) = A.bottomRows(z).cast<Complex>();
  return half;
}

MatrixXcd half_of_both(const MatrixXd& A, Index b) {
  if (A.size() == 0) return {};
  const MatrixXcd rows = half(A, b);
  const Index z = A.cols() - 2 * b;
  const Complex i(0, 1);
  MatrixXcd both(b + z, b + z);
  both.leftCols(b) = std::sqrt(0.5) * (rows.leftCols(b) - i * rows.middleCols(b, b));
  both.rightCols(z) = rows.rightCols(z);
  return both;
}

}  // namespace

WaveStructure reduce_wave(const scene::Matrices& sector, const Wave& wave, const std::vector<int>& kept,
                          const Purpose& purpose, const control::Control& control) {
  const InWave in(sector, wave);
  const auto b = static_cast<Index>(kept.size());
  std::vector<int> twice;
  for (const int offset : {0, in.size()})
    for (const int row : kept) twice.push_back(offset + in.place(row));
  // U f as its real and its imaginary part.
  const MatrixXcd loads = in.loads(purpose.loads);
  Purpose of_both = purpose;
  if (of_both.modes > 0) of_both.modes *= 2;
  of_both.loads.resize(2 * in.size(), 2 * loads.cols());
  of_both.loads << loads.real(), loads.imag(), loads.imag(), -loads.real();
  const Reduced reduced = reduce(doubled(sector, in), twice, of_both, control);
  WaveStructure half_of;
  half_of.M = half_of_both(reduced.M, b);
  half_of.C = half_of_both(reduced.C, b);
  half_of.K = half_of_both(reduced.K, b);
  half_of.G = half_of_both(reduced.G, b);
  half_of.N = half_of_both(reduced.N, b);
  half_of.K2 = half_of_both(reduced.K2, b);
  const MatrixXcd both = half(reduced.loads, b);
  half_of.loads =
      std::sqrt(0.5) * (both.leftCols(loads.cols()) + Complex(0, 1) * both.rightCols(loads.cols()));
  half_of.error = reduced.error;
  half_of.free_below = reduced.free_below;
  return half_of;
}

WaveStructure whole_wave(const scene::Matrices& sector, const Wave& wave, const std::vector<int>& rows,
                         const MatrixXd& loads) {
  const InWave in(sector, wave);
  std::vector<Index> at(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    at[static_cast<std::size_t>(in.place(rows[k]))] = static_cast<Index>(k);
  const auto place = [&](int i) { return at[static_cast<std::size_t>(i)]; };
  const auto dense = [&](const scene::MatrixFile& file) {
    if (!file.matrix) return MatrixXcd();
    MatrixXcd A = MatrixXcd::Zero(in.size(), in.size());
    in.for_each(*file.matrix, [&](int i, int j, Complex value) { A(place(i), place(j)) += value; });
    return A;
  };
  const auto hermitian = [](const MatrixXcd& A) { return MatrixXcd(0.5 * (A + A.adjoint())); };
  const auto skew = [](const MatrixXcd& A) { return MatrixXcd(0.5 * (A - A.adjoint())); };
  WaveStructure whole;
  whole.M = hermitian(dense(sector.mass));
  whole.K = dense(sector.stiffness);
  whole.C = dense(sector.damping);
  if (!sector.unsymmetric_stiffness) whole.K = hermitian(whole.K);
  if (!sector.unsymmetric_damping) whole.C = hermitian(whole.C);
  whole.K2 = hermitian(dense(sector.stiffness_speed_squared));
  whole.G = skew(dense(sector.gyroscopic));
  whole.N = skew(dense(sector.circulatory));
  const MatrixXcd in_rows = in.loads(loads);
  whole.loads.resize(in_rows.rows(), in_rows.cols());
  for (int i = 0; i < in.size(); ++i) whole.loads.row(place(i)) = in_rows.row(i);
  return whole;
}

}  // namespace arcslip::structure
