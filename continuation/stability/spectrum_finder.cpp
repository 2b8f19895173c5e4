#include <arcslip/continuation/stability/spectrum_finder.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/stability/shifted_inverse.hpp>

#include <Spectra/GenEigsSolver.h>
#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

// Arnoldi's method with implicit restarts for Re((J - i w M)^-1 M), whose eigenvalues are
//
//   nu = (1 / (mu - i w) + 1 / (mu + i w)) / 2 = mu / (mu^2 + w^2),
//
// so that the largest |nu| belong to the mu next to +- i w; infinite mu, of a singular M, have nu = 0. They
// converge first: where the smallest one found is nu_k, and all larger ones that were wanted have converged,
// none is expected to be missed for which |nu| > nu_k, as on the axis between
//
//   (-+ 1 / nu_k + sqrt(1 / nu_k^2 + 4 w^2)) / 2.

AxisRange range_of(double w, double least) {
  const double reach = 1 / least, middle = std::sqrt(reach * reach + 4 * w * w);
  return {std::max(0.0, (middle - reach) / 2), (middle + reach) / 2};
}

// Spectra's solver, with the nu that it wanted, in their order, whether they have converged or not.
class AxisArnoldi : public Spectra::GenEigsSolver<ShiftedInverse> {
 public:
  using GenEigsSolver::GenEigsSolver;
  Eigen::VectorXcd wanted() const { return m_ritz_val.head(m_nev); }
};

// mu of nu: of the two roots the one that v has the smaller residual for.
std::complex<double> mu_of(std::complex<double> nu, double w, const ShiftedInverse& inverse,
                           const Eigen::VectorXcd& v) {
  const std::complex<double> root = std::sqrt(1.0 - 4 * w * w * nu * nu);
  const std::complex<double> above = inverse.better((1.0 + root) / (2.0 * nu), v),
                             below = inverse.better((1.0 - root) / (2.0 * nu), v);
  return inverse.residual(above, v) <= inverse.residual(below, v) ? above : below;
}

// x -> J^-1 x, as Spectra asks for it.
struct FactoredInverse {
  using Scalar = double;
  const Eigen::SimplicialLDLT<SparseMatrix>& factors;

  Eigen::Index rows() const { return factors.rows(); }
  Eigen::Index cols() const { return factors.rows(); }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Vector>(out, rows()) = factors.solve(Eigen::Map<const Vector>(in, rows()));
  }
};

struct NearEigenvalues {
  std::vector<std::complex<double>> values;
  Eigen::VectorXd start;  // of a space that has them, to begin with at a neighbouring point
  AxisRange range;        // upper = lower: none
};

// start: n, or empty. Values whose residual exceeds the root of the tolerance are left out. Nothing found
// where J - i w M is singular.
NearEigenvalues eigenvalues_near(ShiftedInverse& inverse, double w, const StabilityOptions& options,
                                 const Eigen::VectorXd& start) try {
  NearEigenvalues found;
  const Eigen::Index n = inverse.rows(), wanted = std::min<Eigen::Index>(options.near_shift, n - 2),
                     krylov = std::min<Eigen::Index>(options.krylov, n);
  inverse.set_shift(0, w);
  AxisArnoldi solver(inverse, wanted, krylov);
  if (start.size() == n && start.norm() > 0)
    solver.init(start.data());
  else
    solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, options.restarts, options.tolerance);
  const Eigen::VectorXcd converged = solver.eigenvalues();
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  double least = std::numeric_limits<double>::infinity(), missed = 0;
  found.start = Eigen::VectorXd::Zero(n);
  Eigen::Index i = 0;  // of those that have converged
  for (const std::complex<double>& nu : solver.wanted()) {
    const bool has_converged = i < converged.size() && nu == converged[i];
    const std::complex<double> mu = has_converged ? mu_of(nu, w, inverse, vectors.col(i)) : 0;
    if (has_converged && inverse.residual(mu, vectors.col(i)) <= std::sqrt(options.tolerance)) {
      found.values.push_back(mu);
      found.start += vectors.col(i).real();
      least = std::min(least, std::abs(nu));
    } else {
      missed = std::max(missed, std::abs(nu));
    }
    if (has_converged) ++i;
  }
  least = std::max(least, missed);
  if (least > 0 && std::isfinite(least)) found.range = range_of(w, least);
  return found;
} catch (const std::exception&) {  // as it says
  return {};
}

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double same_eigenvalue = 1e-6;       // relative: found by two shifts
constexpr double symmetric_rounding = 1e-14;   // of J - J^T, relative
constexpr double least_inertia_pivot = 1e-13;  // of the largest entry of D: below, its sign is rounding
constexpr double next_shift_ratio = 2;         // the next shift, over the end of the last range

bool is_symmetric(const SparseMatrix& J) {
  const SparseMatrix difference = J - SparseMatrix(J.transpose());
  return difference.norm() <= symmetric_rounding * J.norm();
}

// The ranges in order, those that overlap joined.
std::vector<AxisRange> joined(std::vector<AxisRange> ranges) {
  std::sort(ranges.begin(), ranges.end(), [](auto& a, auto& b) { return a.lower < b.lower; });
  std::vector<AxisRange> all;
  for (const AxisRange& each : ranges)
    if (!all.empty() && each.lower <= all.back().upper)
      all.back().upper = std::max(all.back().upper, each.upper);
    else
      all.push_back(each);
  return all;
}

bool is_among(const std::vector<std::complex<double>>& all, std::complex<double> value) {
  return std::any_of(all.begin(), all.end(), [&](const auto& other) {
    return std::abs(value - other) <= same_eigenvalue * std::abs(other);
  });
}

}  // namespace

Spectrum SpectrumFinder::at(const Jacobian& J) {
  Spectrum found;
  if (options_.solver) {
    found = options_.solver(J, options_.mass.get(), has_before_ ? &before_ : nullptr);
  } else if (const auto* dense = std::get_if<Matrix>(&J)) {
    found = dense->rows() <= options_.dense ? by_all(*dense) : by_shifts(dense->sparseView());
  } else if (const auto* sparse = std::get_if<SparseMatrix>(&J)) {
    if (sparse->rows() <= options_.dense) {
      found = by_all(Matrix(*sparse));
    } else {
      auto counted = options_.mass || !is_symmetric(*sparse) ? std::nullopt : by_inertia(*sparse);
      found = counted ? std::move(*counted) : by_shifts(*sparse);
    }
  } else {
    throw std::invalid_argument(
        "the Jacobian is an operator: its eigenvalues ask for a solver of your own "
        "(StabilityOptions::solver)");
  }
  before_ = found;
  has_before_ = true;
  return found;
}

// The largest real parts first; of a pair, the positive imaginary part.
void SpectrumFinder::sort(Spectrum& found) const {
  std::stable_sort(found.leading.begin(), found.leading.end(), [](const auto& x, const auto& y) {
    return x.real() != y.real() ? x.real() > y.real() : x.imag() > y.imag();
  });
  const auto kept = static_cast<std::size_t>(options_.leading);
  if (found.leading.size() > kept) found.leading.resize(kept);
}

Spectrum SpectrumFinder::by_all(const Matrix& J) {
  const Eigen::VectorXcd values =
      options_.mass ? finite_eigenvalues(J, Matrix(*options_.mass)) : eigenvalues(J);
  if (values.size() == 0 && J.rows() > 0 && !options_.mass)
    throw std::runtime_error("the eigenvalues of the Jacobian could not be computed");
  Spectrum found;
  found.complete = true;
  found.found_near = {{0, unbounded}};
  found.leading.assign(values.begin(), values.end());
  found.unstable = static_cast<int>((values.real().array() > 0).count());
  sort(found);
  return found;
}

// J = L D L^T has as many positive eigenvalues as D positive entries (Sylvester). Nothing where a pivot is
// rounding: J is not permuted for stability.
std::optional<Spectrum> SpectrumFinder::by_inertia(const SparseMatrix& J) {
  const Eigen::SimplicialLDLT<SparseMatrix> factors(J);
  if (factors.info() != Eigen::Success) return {};
  const Vector D = factors.vectorD();
  if (!D.allFinite() || D.cwiseAbs().minCoeff() <= least_inertia_pivot * D.cwiseAbs().maxCoeff()) return {};
  Spectrum found;
  look_near_zero(factors, found);
  found.complete = true;
  found.found_near = {{0, unbounded}};
  found.unstable = static_cast<int>((D.array() > 0).count());
  sort(found);
  return found;
}

// Those of a symmetric J next to 0, by Lanczos' method for J^-1 with the factors that have counted them.
void SpectrumFinder::look_near_zero(const Eigen::SimplicialLDLT<SparseMatrix>& factors, Spectrum& found) {
  const Eigen::Index n = factors.rows(), wanted = std::min<Eigen::Index>(options_.leading, n - 1),
                     krylov =
                         std::min<Eigen::Index>(std::max(options_.krylov / 2, 2 * options_.leading + 1), n);
  if (shifts_.empty()) shifts_.push_back({});
  Eigen::VectorXd& start = shifts_.front().start;
  FactoredInverse inverse{factors};
  Spectra::SymEigsSolver<FactoredInverse> solver(inverse, wanted, krylov);
  if (start.size() == n && start.norm() > 0)
    solver.init(start.data());
  else
    solver.init();
  if (solver.compute(Spectra::SortRule::LargestMagn, options_.restarts, options_.tolerance) == 0) return;
  for (const double nu : solver.eigenvalues()) found.leading.emplace_back(1 / nu);
  start = solver.eigenvectors().rowwise().sum();
}

void SpectrumFinder::look_near(ShiftedInverse& inverse, Shift& shift, Spectrum& found) {
  NearEigenvalues near = eigenvalues_near(inverse, shift.w, options_, shift.start);
  for (const auto& value : near.values)
    if (!is_among(found.leading, value)) found.leading.push_back(value);
  if (near.range.upper > near.range.lower) found.found_near.push_back(near.range);
  shift.start = std::move(near.start);
}

// In the lowest gap of the axis that is to be covered. Nothing: there is none, or no range to begin with.
std::optional<double> SpectrumFinder::next_shift(const std::vector<AxisRange>& ranges) const {
  if (ranges.empty()) return {};
  if (ranges.front().lower > 0) return ranges.front().lower / 2;
  const double end = ranges.front().upper, bound = options_.largest_frequency;
  if (bound > 0 && end >= bound) return {};
  if (ranges.size() > 1) return (end + ranges[1].lower) / 2;
  return bound > 0 ? std::min(next_shift_ratio * end, bound) : next_shift_ratio * end;
}

// What the shifts have missed is found once more by a shift next to it, with its neighbours.
void SpectrumFinder::look_at_any_frequency(const SparseMatrix& J, ShiftedInverse& inverse, Spectrum& found) {
  auto nearest = nearest_to_axis(J, options_.mass.get(), options_, nearest_vector_);
  nearest_vector_ = nearest ? std::move(nearest->vector) : Eigen::VectorXcd();
  if (!nearest) return;
  found.nearest = nearest->value;
  if (is_among(found.leading, nearest->value)) return;
  missed_.w = nearest->value.imag();
  look_near(inverse, missed_, found);
  found.found_near = joined(std::move(found.found_near));
  const auto same = std::find_if(found.leading.begin(), found.leading.end(), [&](const auto& each) {
    return std::abs(each - nearest->value) <= std::sqrt(options_.tolerance) * std::abs(each);
  });
  if (same != found.leading.end()) {  // by the shift, which is more accurate
    found.nearest = *same;
    return;
  }
  found.leading.push_back(nearest->value);
  if (nearest->value.imag() > 0) found.leading.push_back(std::conj(nearest->value));
}

Spectrum SpectrumFinder::by_shifts(const SparseMatrix& J) {
  if (shifts_.empty()) {
    shifts_.push_back({});
    for (const double w : options_.frequencies) shifts_.push_back({w, {}});
  }
  Spectrum found;
  ShiftedInverse inverse(J, options_.mass.get());
  for (Shift& shift : shifts_) look_near(inverse, shift, found);
  found.found_near = joined(std::move(found.found_near));
  while (shifts_.size() < static_cast<std::size_t>(options_.shifts)) {
    const auto w = next_shift(found.found_near);
    if (!w || !std::isfinite(*w)) break;
    shifts_.push_back({*w, {}});
    look_near(inverse, shifts_.back(), found);
    found.found_near = joined(std::move(found.found_near));
  }
  if (options_.second_opinion) look_at_any_frequency(J, inverse, found);
  found.unstable = static_cast<int>(std::count_if(found.leading.begin(), found.leading.end(),
                                                  [](const auto& each) { return each.real() > 0; }));
  sort(found);
  return found;
}

}  // namespace arcslip::continuation
