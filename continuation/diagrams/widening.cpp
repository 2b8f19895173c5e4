#include <arcslip/continuation/diagrams/widening.hpp>

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/diagrams/branch_parts.hpp>
#include <arcslip/continuation/events/root.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>
#include <utility>

namespace arcslip::continuation {
namespace {

// The singular vectors of the smallest singular value, by inverse iteration. D: next to a matrix of this
// norm.
void smallest(const Matrix& matrix, double norm, int sweeps, LU<double>& D, Vector& left, Vector& right) {
  D.factorize(matrix);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    if (D.pivot(i) == 0) {  // to the last bit: next to it the vectors are the same
      D.factorize(matrix + std::numeric_limits<double>::epsilon() * norm *
                               Matrix::Identity(matrix.rows(), matrix.cols()));
      break;
    }
  for (Eigen::Index i = 0; i < right.size(); ++i) right[i] = std::sin(0.7 * static_cast<double>(i * i) + 0.3);
  right.normalize();
  for (int k = 0; k < sweeps; ++k) {
    D.solve_transposed(right, left);
    left.normalize();
    D.solve(left, right);
    right.normalize();
  }
}

// The rows and columns of a Jacobian.
Matrix block(const Jacobian& J, const std::vector<int>& of) {
  if (const auto* dense = std::get_if<Matrix>(&J)) return (*dense)(of, of);
  const auto* sparse = std::get_if<SparseMatrix>(&J);
  if (!sparse) throw std::invalid_argument("a problem that widens needs a Jacobian that is a matrix");
  const auto size = static_cast<Eigen::Index>(of.size());
  Matrix all(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j)
      all(i, j) = sparse->coeff(of[static_cast<std::size_t>(i)], of[static_cast<std::size_t>(j)]);
  return all;
}

}  // namespace

WiderBranchPoints::WiderBranchPoints(Widening problems, const WideningOptions& options)
    : of_(std::move(problems)),
      options_(options),
      at_(of_.wide->evaluator()),
      p_(parameter_values(*of_.wide)),
      u_(of_.wide->size()) {}

// Sets u_ and D_.
bool WiderBranchPoints::move_to(const Vector& v) {
  const Eigen::Index n = v.size() - 1;
  of_.embed(v.head(n), u_);
  p_[of_.free] = v[n];
  try {
    if (at_->move_to(u_, p_, Needs::jacobian) != Evaluated::ok) return false;
  } catch (const std::exception&) {
    return false;
  }
  D_ = block(at_->jacobian(), of_.added);
  return D_.allFinite();
}

// Of det D; 0: not known.
int WiderBranchPoints::sign_at(const Vector& v) {
  if (!move_to(v)) return 0;
  lu_.factorize(D_);
  int sign = static_cast<int>(lu_.permutation_sign());
  for (Eigen::Index i = 0; i < D_.rows(); ++i) sign *= lu_.pivot(i) > 0 ? 1 : (lu_.pivot(i) < 0 ? -1 : 0);
  return sign;
}

std::variant<Junction, NotWidened> WiderBranchPoints::locate(const std::vector<Vector>& branch,
                                                             std::size_t after) {
  NotWidened why = NotWidened::no_crossing;
  std::vector<std::optional<int>> signs(branch.size());
  const auto sign = [&](std::size_t i) {
    if (!signs[i]) signs[i] = sign_at(branch[i]);
    return *signs[i];
  };
  const auto in_step = [&](std::size_t i) -> std::optional<Junction> {
    if (i + 1 >= branch.size() || sign(i) * sign(i + 1) >= 0) return {};
    auto found = refine(branch[i], branch[i + 1]);
    if (const auto* failed = std::get_if<NotWidened>(&found)) {
      why = *failed;
      return {};
    }
    Junction& junction = std::get<Junction>(found);
    const Vector x = joined(junction.u, junction.parameter);
    const auto is_it = [&](const Vector& other) {
      return (other - x).norm() <= options_.same_place * other.norm();
    };
    if (std::any_of(found_.begin(), found_.end(), is_it)) return {};
    found_.push_back(x);
    return std::move(junction);
  };
  for (std::size_t d = 0; d <= static_cast<std::size_t>(options_.points_around); ++d) {
    if (auto found = in_step(after + d)) return std::move(*found);
    if (d == 0 || d > after) continue;
    if (auto found = in_step(after - d)) return std::move(*found);
  }
  return why;
}

// From u_ and p_, in the direction of a vector of the added unknowns.
Junction WiderBranchPoints::junction_along(const Vector& added) const {
  Vector direction = Vector::Zero(u_.size() + 1);
  for (std::size_t i = 0; i < of_.added.size(); ++i)
    direction[of_.added[i]] = added[static_cast<Eigen::Index>(i)];
  Counts counts;
  const Corrector with(*of_.wide, p_, of_.free, {}, counts);
  direction /= std::sqrt(with.dot(direction, direction));
  Junction junction{of_.wide, u_, p_[of_.free]};
  junction.half_branches.push_back({std::move(direction), -1, {}});
  junction.images = true;
  return junction;
}

// Between two points of the branch with different signs.
std::variant<Junction, NotWidened> WiderBranchPoints::refine(const Vector& from, const Vector& to) {
  const Eigen::Index n = from.size() - 1;
  Vector p = parameter_values(*of_.narrow);
  p[of_.free] = from[n];
  Counts counts;
  Corrector branch(*of_.narrow, p, of_.free, {}, counts);
  Vector chord = to - from;
  chord /= std::sqrt(branch.dot(chord, chord));
  const Vector row = branch.border_row(chord);
  Vector v;
  const auto place = [&](double share) {
    v = (1 - share) * from + share * to;
    return branch.correct(v, row, false).converged && move_to(v);
  };
  double a = 0, b = 1;
  const int sign_a = sign_at(from);
  const double norm = D_.norm();
  const auto size = static_cast<Eigen::Index>(of_.added.size());
  Vector left(size), right(size), solution(size);
  // 1/(right . D^-1 left): of the size of the smallest singular value, and zero with it.
  const auto value = [&](double share) {
    if (!place(share)) return std::nan("");
    lu_.factorize(D_);
    lu_.solve(left, solution);
    return 1 / right.dot(solution);
  };
  for (int k = 0; k < options_.bisections; ++k) {
    if (!place(0.5 * (a + b))) return NotWidened::not_evaluated;
    smallest(D_, norm, options_.sweeps, lu_, left, right);
    const double at_a = value(a), at_b = value(b);
    if (at_a * at_b < 0) {
      const auto root = find_root(value, a, at_a, b, at_b, options_.resolved_step);
      const double least = std::min(std::abs(root.f_lower), std::abs(root.f_upper));
      if (least <= options_.continuous * std::max(std::abs(at_a), std::abs(at_b)) && place(root.x)) {
        smallest(D_, norm, options_.sweeps, lu_, left, right);
        lu_.factorize(D_ + norm * left * right.transpose());
        if (!(lu_.reciprocal_condition() >= options_.singular)) return NotWidened::several_cross;
        return junction_along(right);
      }
    }
    const double middle = 0.5 * (a + b);
    if (!place(middle)) return NotWidened::not_evaluated;
    const Vector there = v;
    const int sign = sign_at(there);
    (sign == sign_a ? a : b) = middle;
  }
  return NotWidened::jumps;
}

}  // namespace arcslip::continuation
