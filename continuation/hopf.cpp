#include <arcslip/continuation/hopf.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <complex>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace arcslip::continuation {
namespace {

constexpr const char* not_computed = "the eigenvalues of the Jacobian could not be computed";

// The eigenvalues of J by falling real parts, for all monitors of one place: computed where J is another one.
class Spectrum {
 public:
  explicit Spectrum(Vector scales) : scales_(std::move(scales)) {}

  std::complex<double> eigenvalue(const Jacobian& jacobian, std::size_t k) {
    to_dense(jacobian, J_);
    if (eigenvalues_.empty() || J_ != at_) {
      at_ = J_;
      solver_.compute(at_, false);
      if (solver_.info() != Eigen::Success) throw std::runtime_error(not_computed);
      const auto& all = solver_.eigenvalues();
      eigenvalues_.assign(all.begin(), all.end());
      std::stable_sort(eigenvalues_.begin(), eigenvalues_.end(),
                       [](const auto& x, const auto& y) { return x.real() > y.real(); });
    }
    return eigenvalues_[k];
  }

  // Of the pair nearest to the imaginary axis.
  EventData hopf(const Jacobian& jacobian) {
    to_dense(jacobian, J_);
    const Eigen::EigenSolver<Matrix> solver(J_);
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < J_.rows(); ++i) {
      const auto mu = solver.eigenvalues()[i];
      if (mu.imag() > 0 && (best < 0 || std::abs(mu.real()) < std::abs(solver.eigenvalues()[best].real())))
        best = i;
    }
    if (best < 0) return {};
    Eigen::VectorXcd z = solver.eigenvectors().col(best).cwiseQuotient(scales_.cast<std::complex<double>>());
    z /= z.norm();
    // By the phase that makes sum z_i^2 = |a|^2 - |b|^2 + 2i a . b real and not negative.
    z *= std::polar(1.0, -0.5 * std::arg(z.cwiseProduct(z).sum()));
    Eigen::Index largest;
    z.real().cwiseAbs().maxCoeff(&largest);
    if (z[largest].real() < 0) z = -z;
    return Hopf{solver.eigenvalues()[best].imag(), z.real().cwiseProduct(scales_),
                z.imag().cwiseProduct(scales_)};
  }

 private:
  Vector scales_;
  Matrix J_, at_;
  Eigen::EigenSolver<Matrix> solver_;
  std::vector<std::complex<double>> eigenvalues_;
};

}  // namespace

void to_dense(const Jacobian& J, Matrix& dense) {
  if (const auto* full = std::get_if<Matrix>(&J))
    dense = *full;
  else if (const auto* sparse = std::get_if<SparseMatrix>(&J))
    dense = *sparse;
  else
    throw std::invalid_argument(
        "the Jacobian is an operator, whose eigenvalues cannot be computed: Hopf points need a dense or a "
        "sparse one");
}

std::vector<Monitor> hopf_monitors(const Problem& problem) {
  const int n = problem.size();
  if (n > largest_spectrum)
    throw std::invalid_argument("Hopf points are looked for with at most " +
                                std::to_string(largest_spectrum) + " unknowns, not " + std::to_string(n) +
                                ": all eigenvalues are computed at each point");
  const auto spectrum = std::make_shared<Spectrum>(problem.scales());
  std::vector<Monitor> monitors(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < monitors.size(); ++k) {
    monitors[k].name = "hopf";
    monitors[k].value = [=](const Accepted& now) {
      return spectrum->eigenvalue(now.at.jacobian(), k).real();
    };
    monitors[k].is_event = [=](const Accepted& now) {
      return spectrum->eigenvalue(now.at.jacobian(), k).imag() != 0;
    };
    monitors[k].describe = [=](const Accepted& now) { return spectrum->hopf(now.at.jacobian()); };
  }
  return monitors;
}

}  // namespace arcslip::continuation
