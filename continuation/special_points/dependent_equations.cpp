#include <arcslip/continuation/special_points/dependent_equations.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/problem/text.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr Eigen::Index most_equations = 100;        // looked at: a singular value decomposition of this size
constexpr int more_places = 3;                      // than there are equations
constexpr double far_shares[] = {0.1, 1e-2, 1e-3};  // of u and p, or of their scales: of the places looked at
constexpr double dependence_rounding = 1e-12;       // singular values of F, in rows of equal size
constexpr double rank_lost = 1e-8;                  // of [J F_p], which may come from differences
constexpr double rounding_of_sums = 1e-9;           // of the coefficients of a combination
constexpr double least_pivot = 1e-4;                // of the largest coefficient
constexpr Eigen::Index most_terms = 8, most_sums = 4;  // in a message

// Between -1 and 1, without a pattern.
double generic_place(int place, Eigen::Index i) {
  return std::sin(1.3 + 2.17 * static_cast<double>(i) * (1 + 0.37 * place) + 4.1 * place);
}

Vector scales_of(const Problem& problem, int along) {
  Vector scales(problem.size() + 1);
  scales << problem.scales(), problem.parameters()[static_cast<std::size_t>(along)].change();
  return scales;
}

// F at generic places around v, a column each, in rows of equal size. Nothing if it cannot be evaluated.
std::optional<Matrix> samples_of_F(const Problem& problem, const Vector& v, Vector p, int along,
                                   Vector& sizes) {
  const Eigen::Index n = problem.size();
  const Vector scales = scales_of(problem, along);
  const auto at = problem.evaluator();
  Matrix F(n, n + more_places);
  const auto fill = [&](double share) {
    for (int j = 0; j < F.cols(); ++j) {
      Vector x = v;
      for (Eigen::Index i = 0; i <= n; ++i)
        x[i] += share * std::max(std::abs(v[i]), scales[i]) * generic_place(j, i);
      p[along] = x[n];
      if (at->move_to(x.head(n), p, Needs::residual) != Evaluated::ok) return false;
      F.col(j) = at->residual();
    }
    return F.allFinite();
  };
  for (const double share : far_shares) {
    if (!fill(share)) continue;
    sizes = F.rowwise().lpNorm<Eigen::Infinity>();
    for (double& size : sizes) size = size > 0 ? size : 1;
    return Matrix(sizes.cwiseInverse().asDiagonal() * F);
  }
  return {};
}

// The rows of L, combinations of equations, reduced to echelon form: as few terms as there may be.
void to_echelon_form(Matrix& L) {
  Eigen::Index k = 0;
  for (Eigen::Index column = 0; column < L.cols() && k < L.rows(); ++column) {
    const auto rest = L.bottomRows(L.rows() - k);
    Eigen::Index row = 0;
    const double pivot = rest.col(column).cwiseAbs().maxCoeff(&row);
    if (pivot <= least_pivot * rest.cwiseAbs().maxCoeff()) continue;
    L.row(k).swap(L.row(k + row));
    L.row(k) /= L(k, column);
    for (Eigen::Index i = 0; i < L.rows(); ++i)
      if (i != k) L.row(i) -= L(i, column) * L.row(k);
    ++k;
  }
}

std::string names_of_sums(const Matrix& L) {
  std::string result;
  for (Eigen::Index k = 0; k < L.rows(); ++k) {
    const std::string sum = k < most_sums ? words_of_sum(L.row(k).transpose(), "F") : std::string();
    if (sum.empty()) return {};
    result += (k == 0 ? "" : k + 1 == L.rows() ? " and " : ", ") + sum + " = 0";
  }
  return result;
}

}  // namespace

std::string words_of_sum(const Eigen::Ref<const Vector>& l, const char* name) {
  const double largest = l.lpNorm<Eigen::Infinity>();
  std::string result;
  Eigen::Index terms = 0;
  for (Eigen::Index i = 0; i < l.size(); ++i) {
    if (std::abs(l[i]) <= rounding_of_sums * largest) continue;
    if (++terms > most_terms) return {};
    const double c = std::abs(l[i]), near = std::abs(c - 1) < rounding_of_sums ? 1 : c;
    result += terms == 1 ? (l[i] < 0 ? "-" : "") : (l[i] < 0 ? " - " : " + ");
    if (near != 1) result += text(std::round(near / rounding_of_sums) * rounding_of_sums, " ");
    result += name + ("[" + std::to_string(i)) + "]";
  }
  return result;
}

std::optional<Matrix> dependent_combinations(const Problem& problem, const Vector& v, const Vector& p,
                                             int along) {
  const Eigen::Index n = problem.size();
  if (n > most_equations) return {};
  Vector sizes;
  const auto F = samples_of_F(problem, v, p, along, sizes);
  if (!F) return {};
  const SingularValues of = singular_values(F->transpose());
  if (of.values.size() < n) return {};
  const double rounding = dependence_rounding * std::max(of.values[0], 1.0) * static_cast<double>(n);
  const Eigen::Index k = (of.values.array() <= rounding).count();
  Matrix L = of.V.rightCols(k).transpose() * sizes.cwiseInverse().asDiagonal();
  to_echelon_form(L);
  return L;
}

std::string doubt_of_dependence(const Problem& problem, const Vector& v, const Vector& p, int along) try {
  const auto found = dependent_combinations(problem, v, p, along);
  if (!found || found->rows() == 0) return {};
  const Matrix& L = *found;
  const Eigen::Index k = L.rows();
  const std::string sums = names_of_sums(L);
  const std::string count = std::to_string(k);
  return "; the solutions here are not isolated: the equations depend on each other, as " +
         (sums.empty() ? count + " combinations of them vanish" : sums) +
         " for all u and p around, so that the solutions form a set of " + count +
         (k == 1 ? " dimension" : " dimensions") +
         " more than a branch. Where a sum of unknowns is conserved, put its value in the place of one of "
         "its equations" +
         (k == 1 ? "" : ", for each");
} catch (const std::exception&) {
  return {};
}

std::string doubt_of_branch_point(const Problem& problem, const Vector& v, const Vector& p, int along) try {
  const Eigen::Index n = problem.size();
  const auto at = problem.evaluator();
  Vector moved = p, F_p(n);
  moved[along] = v[n];
  if (n > most_equations || at->move_to(v.head(n), moved, Needs::jacobian) != Evaluated::ok) return {};
  Matrix D(n, n + 1), J;
  if (const auto* dense = std::get_if<Matrix>(&at->jacobian()))
    J = *dense;
  else if (const auto* sparse = std::get_if<SparseMatrix>(&at->jacobian()))
    J = *sparse;
  else
    return {};
  at->parameter_derivative(along, F_p);
  D << J, F_p;
  D = D * scales_of(problem, along).asDiagonal();
  if (!D.allFinite()) return {};
  for (Eigen::Index i = 0; i < n; ++i)
    if (const double size = D.row(i).lpNorm<Eigen::Infinity>(); size > 0) D.row(i) /= size;
  const Vector values = singular_values(D.transpose()).values;
  if (!(values[n - 1] <= rank_lost * values[0])) return {};
  return "; it is a branch point, where [J F_p] has a rank below n, and no tangent reports the branches that "
         "cross apart: start next to it, at another value of the parameter, and let branch_point_monitor() "
         "find it";
} catch (const std::exception&) {
  return {};
}

}  // namespace arcslip::continuation
