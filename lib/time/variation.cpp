#include <arcslip/time/variation.hpp>

#include <algorithm>
#include <cmath>

namespace arcslip::time {
namespace {

constexpr std::size_t most_terms = 64;
constexpr double longest = 2;       // rad of the fastest motion, in one series
constexpr int few = 4;              // series in a row cost less than halving and squaring
constexpr double left_out = 1e-19;  // by the first term that is left out, relative

// The first k with x^k/k! below left_out.
std::size_t terms_of(double x) {
  double term = 1;
  std::size_t k = 0;
  while (term > left_out && k < most_terms) term *= x / static_cast<double>(++k);
  return std::max<std::size_t>(k, 2);
}

}  // namespace

void Variation::move(double h, double fastest, const Matrix& K, const Matrix& C, const Matrix& G,
                     const std::vector<Variable>& variables, Matrix& W, Matrix& V) {
  if (!(h > 0)) return;
  take(K, C);
  const double pieces = std::max(1.0, std::ceil(h * fastest / longest));
  if (!variables.empty() || pieces <= 1) return series(h, fastest, G, variables, W, V);
  if (pieces > few) return squared(h, fastest, std::ilogb(pieces) + 1, G, W, V);
  for (int i = 0; i < static_cast<int>(pieces); ++i) series(h / pieces, fastest, G, variables, W, V);
}

void Variation::take(const Matrix& K, const Matrix& C) {
  rows_.resize(static_cast<std::size_t>(K.rows()));
  for (Eigen::Index i = 0; i < K.rows(); ++i) {
    auto& row = rows_[static_cast<std::size_t>(i)];
    row.clear();
    for (Eigen::Index j = 0; j < K.cols(); ++j)
      if (K(i, j) != 0 || C(i, j) != 0) row.push_back({j, K(i, j), C(i, j)});
  }
}

void Variation::series(double h, double fastest, const Matrix& G, const std::vector<Variable>& variables,
                       Matrix& W, Matrix& V) {
  const std::size_t terms = terms_of(h * fastest);
  w_ = W;
  v_ = V;
  next_w_.resizeLike(W);
  next_v_.resizeLike(V);
  along_w_.resize(std::max(along_w_.size(), variables.size() * most_terms));
  along_v_.resize(along_w_.size());
  for (std::size_t k = 0; k < terms; ++k) {
    const double factor = h / static_cast<double>(k + 1);
    next_w_ = factor * v_;
    for (Eigen::Index i = 0; i < W.cols(); ++i) {
      auto next = next_v_.col(i);
      if (k == 0 && G.size() > 0)
        next = factor * G.col(i);
      else
        next.setZero();
      for (const Entry& entry : rows_[static_cast<std::size_t>(i)]) {
        if (entry.k != 0) next -= factor * entry.k * w_.col(entry.column);
        if (entry.c != 0) next -= factor * entry.c * v_.col(entry.column);
      }
    }
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const Variable& part = variables[i];
      const auto at = [&](std::size_t term) { return i * most_terms + term; };
      along_w_[at(k)].noalias() = w_ * part.directions;
      along_v_[at(k)].noalias() = v_ * part.directions;
      sum_.setZero(W.rows(), part.directions.cols());
      for (std::size_t j = 0; j <= k && j < part.T.size(); ++j) {
        sum_.noalias() += along_w_[at(k - j)] * part.T[j].transpose();
        if (!part.B.empty()) sum_.noalias() += along_v_[at(k - j)] * part.B[j].transpose();
      }
      next_v_.noalias() -= factor * sum_ * part.over_mass.transpose();
    }
    W += next_w_;
    V += next_v_;
    w_.swap(next_w_);
    v_.swap(next_v_);
  }
}

// The map of (w, w', G as inputs) over h/2^halvings, squared as often: from the right, as the w are rows.
void Variation::squared(double h, double fastest, int halvings, const Matrix& G, Matrix& W, Matrix& V) {
  const Eigen::Index n = W.cols(), inputs = G.size() > 0 ? n : 0, size = 2 * n + inputs;
  map_w_.setZero(size, n);
  map_v_.setZero(size, n);
  map_w_.topRows(n).setIdentity();
  map_v_.middleRows(n, n).setIdentity();
  input_.setZero(inputs > 0 ? size : 0, inputs);
  input_.bottomRows(inputs).setIdentity();
  series(std::ldexp(h, -halvings), fastest, input_, {}, map_w_, map_v_);
  map_.setZero(size, size);
  map_.leftCols(n) = map_w_;
  map_.middleCols(n, n) = map_v_;
  map_.bottomRightCorner(inputs, inputs).setIdentity();
  for (int i = 0; i < halvings; ++i) {
    twice_.noalias() = map_ * map_;
    map_.swap(twice_);
  }
  state_.resize(W.rows(), size);
  state_.leftCols(n) = W;
  state_.middleCols(n, n) = V;
  if (inputs > 0) state_.rightCols(n) = G;
  moved_.noalias() = state_ * map_;
  W = moved_.leftCols(n);
  V = moved_.middleCols(n, n);
}

}  // namespace arcslip::time
