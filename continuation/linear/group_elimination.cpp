#include <arcslip/continuation/linear/group_elimination.hpp>

#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/linear/lapack.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace arcslip::continuation {
namespace {

// Elimination before the others is no partial pivoting: errors grow as X_g does, and where A_g is nearly
// singular, as at a resonance of what is eliminated, the other equations must take part.
constexpr double largest_growth = 1e3, smallest_pivot = 1e-9;  // of X_g; of the largest pivot
constexpr Eigen::Index smallest_share = 8;                     // fewer than n/8 unknowns are not worth it

using ConstMatrixMap = Eigen::Map<const Matrix>;
using MatrixMap = Eigen::Map<Matrix>;

}  // namespace

GroupElimination::GroupElimination(const std::vector<int>& groups) : of_(groups) {
  if (of_.empty()) return;
  if (*std::min_element(of_.begin(), of_.end()) < 0)
    throw std::invalid_argument("the groups of unknowns are numbers from 0 on");
  groups_.resize(static_cast<std::size_t>(*std::max_element(of_.begin(), of_.end())) + 1);
  for (std::size_t i = 0; i < of_.size(); ++i)
    groups_[static_cast<std::size_t>(of_[i])].all.push_back(static_cast<int>(i));
}

bool GroupElimination::may_pay(const Matrix& J) const {
  return groups_.size() > 1 && J.rows() >= lapack::smallest_lu;
}

void GroupElimination::resize(Eigen::Index n, Eigen::Index m) {
  if (m_ == m) return;
  m_ = m;
  kept_.reserve(static_cast<std::size_t>(n));
  outside_.resize(n);
  others_.resize(n, static_cast<Eigen::Index>(groups_.size()));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index g = 0; g < others_.cols(); ++g)
      others_(i, g) = of_[static_cast<std::size_t>(i)] == g ? 0 : 1;
  for (Group& group : groups_) {
    const auto size = group.all.size();
    group.eliminated.reserve(size);
    group.kept.reserve(size);
    group.A.resize(size * size);
    group.X.resize(size * (size + static_cast<std::size_t>(m)));
    group.B.resize(size * static_cast<std::size_t>(n + m));
    group.order.resize(size);
    group.work.resize(size);
    group.y.resize(static_cast<Eigen::Index>(size));
  }
}

bool GroupElimination::eliminate(const Matrix& J, const Borders& borders) {
  if (!of_.empty() && J.rows() != static_cast<Eigen::Index>(of_.size()))
    throw std::invalid_argument("the Jacobian has " + std::to_string(J.rows()) + " unknowns, and " +
                                std::to_string(of_.size()) + " are in groups");
  if (!may_pay(J)) return false;
  resize(J.rows(), borders.width());
  if (!classify(J)) return false;
  kept_.clear();
  bool any = false;
  for (Group& group : groups_) {
    if (group.size() > 0 && !factorize(group, J, borders)) {
      group.eliminated.clear();
      group.kept = group.all;
    }
    any |= group.size() > 0;
    group.first_kept = kept();
    kept_.insert(kept_.end(), group.kept.begin(), group.kept.end());
  }
  sign_ = 1;
  for (Group& group : groups_)
    if (group.size() > 0) gather_rows(group, J, borders), take_sign(group);
  return any;
}

// What each group can lose. False: too little.
bool GroupElimination::classify(const Matrix& J) {
  const Eigen::Index n = J.rows();
  outside_.setZero();
  for (Eigen::Index j = 0; j < n; ++j)
    outside_ += J.col(j).cwiseAbs().cwiseProduct(others_.col(of_[static_cast<std::size_t>(j)]));
  if ((outside_.array() == 0).count() * smallest_share < n) return false;
  for (Group& group : groups_) {
    group.eliminated.clear();
    group.kept.clear();
    for (const int i : group.all) (outside_[i] == 0 ? group.eliminated : group.kept).push_back(i);
  }
  return true;
}

// A_g in factors and X_g; false: not accurate.
bool GroupElimination::factorize(Group& group, const Matrix& J, const Borders& borders) {
  const Eigen::Index size = group.size(), width = group.width();
  MatrixMap A(group.A.data(), size, size), X(group.X.data(), size, width + m_);
  A = J(group.eliminated, group.eliminated);
  factorize_in_place(size, A.data(), group.order.data(), group.work.data());
  const auto pivots = A.diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > smallest_pivot * pivots.maxCoeff())) return false;
  for (Eigen::Index i = 0; i < size; ++i) {
    const int row = group.eliminated[static_cast<std::size_t>(group.order[static_cast<std::size_t>(i)])];
    for (Eigen::Index j = 0; j < width; ++j) X(i, j) = J(row, group.kept[static_cast<std::size_t>(j)]);
    X.row(i).tail(m_) = borders.columns.row(row);
  }
  const auto n = static_cast<int>(size), columns = static_cast<int>(width + m_);
  lapack::solve_triangle("L", "U", n, columns, A.data(), X.data());
  lapack::solve_triangle("U", "N", n, columns, A.data(), X.data());
  if (!X.allFinite()) return false;
  if (width > 0 && X.leftCols(width).cwiseAbs().maxCoeff() > largest_growth) return false;
  return true;
}

void GroupElimination::gather_rows(Group& group, const Matrix& J, const Borders& borders) {
  const Eigen::Index size = group.size();
  MatrixMap B(group.B.data(), size, kept() + m_);
  for (Eigen::Index l = 0; l < size; ++l) {
    const int unknown = group.eliminated[static_cast<std::size_t>(l)];
    for (Eigen::Index r = 0; r < kept(); ++r) B(l, r) = J(kept_[static_cast<std::size_t>(r)], unknown);
    B.row(l).tail(m_) = borders.rows.row(unknown);
  }
}

void GroupElimination::take_sign(Group& group) {
  const Eigen::Index size = group.size();
  const ConstMatrixMap A(group.A.data(), size, size);
  bool odd = false;
  for (Eigen::Index i = 0; i < size; ++i) odd ^= A(i, i) < 0;
  std::copy_n(group.order.begin(), size, group.work.begin());
  for (Eigen::Index i = 0; i < size; ++i)
    for (int& at = group.work[static_cast<std::size_t>(i)]; at != i; odd = !odd)
      std::swap(at, group.work[static_cast<std::size_t>(at)]);
  if (odd) sign_ = -sign_;
}

void GroupElimination::form(const Matrix& J, const Borders& borders, Eigen::Ref<Matrix> S) const {
  const Eigen::Index n = kept(), rows = n + m_;
  S.topLeftCorner(n, n) = J(kept_, kept_);
  S.topRightCorner(n, m_) = borders.columns(kept_, Eigen::all);
  S.bottomLeftCorner(m_, n) = borders.rows(kept_, Eigen::all).transpose();
  S.bottomRightCorner(m_, m_) = borders.corner;
  for (const Group& group : groups_) {
    if (group.size() == 0) continue;
    const Eigen::Index width = group.width();
    const auto size = static_cast<int>(group.size()), stride = static_cast<int>(S.outerStride());
    const lapack::Columns B{group.B.data(), size, static_cast<int>(rows), size};
    const auto subtract = [&](Eigen::Index from, Eigen::Index columns, Eigen::Index to) {
      if (columns == 0) return;
      lapack::multiply(true, -1, B, {group.X.data() + from * size, size, static_cast<int>(columns), size}, 1,
                       S.data() + to * S.outerStride(), stride);
    };
    subtract(0, width, group.first_kept);
    subtract(width, m_, n);
  }
}

void GroupElimination::solve(const Group& group) const {
  const Eigen::Index size = group.size();
  const ConstMatrixMap A(group.A.data(), size, size);
  auto y = group.y.head(size);
  A.triangularView<Eigen::UnitLower>().solveInPlace(y);
  A.triangularView<Eigen::Upper>().solveInPlace(y);
}

void GroupElimination::reduce(In f, Out f_N) const {
  const Eigen::Index n = kept();
  for (Eigen::Index i = 0; i < n; ++i) f_N[i] = f[kept_[static_cast<std::size_t>(i)]];
  f_N.tail(m_) = f.tail(m_);
  for (const Group& group : groups_) {
    if (group.size() == 0) continue;
    for (Eigen::Index i = 0; i < group.size(); ++i)
      group.y[i] = f[group.eliminated[static_cast<std::size_t>(group.order[static_cast<std::size_t>(i)])]];
    solve(group);
    const ConstMatrixMap B(group.B.data(), group.size(), n + m_);
    f_N.noalias() -= B.transpose() * group.y.head(group.size());
  }
}

void GroupElimination::expand(In x_N, Out x) const {
  const Eigen::Index n = kept();
  for (Eigen::Index i = 0; i < n; ++i) x[kept_[static_cast<std::size_t>(i)]] = x_N[i];
  x.tail(m_) = x_N.tail(m_);
  for (const Group& group : groups_) {
    if (group.size() == 0) continue;
    const Eigen::Index size = group.size(), width = group.width();
    const ConstMatrixMap X(group.X.data(), size, width + m_);
    auto y = group.y.head(size);
    y.noalias() -= X.leftCols(width) * x_N.segment(group.first_kept, width);
    y.noalias() -= X.rightCols(m_) * x_N.tail(m_);
    for (Eigen::Index i = 0; i < size; ++i) x[group.eliminated[static_cast<std::size_t>(i)]] = y[i];
  }
}

void GroupElimination::reduce_transposed(In f, Out f_N) const {
  const Eigen::Index n = kept();
  for (Eigen::Index i = 0; i < n; ++i) f_N[i] = f[kept_[static_cast<std::size_t>(i)]];
  f_N.tail(m_) = f.tail(m_);
  for (const Group& group : groups_) {
    if (group.size() == 0) continue;
    const Eigen::Index size = group.size(), width = group.width();
    auto y = group.y.head(size);
    for (Eigen::Index i = 0; i < size; ++i) y[i] = f[group.eliminated[static_cast<std::size_t>(i)]];
    const ConstMatrixMap X(group.X.data(), size, width + m_);
    f_N.segment(group.first_kept, width).noalias() -= X.leftCols(width).transpose() * y;
    f_N.tail(m_).noalias() -= X.rightCols(m_).transpose() * y;
  }
}

void GroupElimination::expand_transposed(In x_N, Out x) const {
  const Eigen::Index n = kept();
  for (Eigen::Index i = 0; i < n; ++i) x[kept_[static_cast<std::size_t>(i)]] = x_N[i];
  x.tail(m_) = x_N.tail(m_);
  for (const Group& group : groups_) {
    if (group.size() == 0) continue;
    const Eigen::Index size = group.size();
    const ConstMatrixMap A(group.A.data(), size, size), B(group.B.data(), size, n + m_);
    auto y = group.y.head(size);
    y.noalias() -= B * x_N;
    A.triangularView<Eigen::Upper>().transpose().solveInPlace(y);
    A.triangularView<Eigen::UnitLower>().transpose().solveInPlace(y);
    for (Eigen::Index i = 0; i < size; ++i)
      x[group.eliminated[static_cast<std::size_t>(group.order[static_cast<std::size_t>(i)])]] = y[i];
  }
}

}  // namespace arcslip::continuation
