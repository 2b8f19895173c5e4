#include <arcslip/time/variation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace arcslip::time {
namespace {

constexpr int most_terms = 60;
constexpr double longest = 2;  // rad of the fastest motion, in one series
constexpr int few = 4;         // series in a row cost less than halving and squaring
constexpr double small = 0.25 * std::numeric_limits<double>::epsilon();

}  // namespace

void Variation::move(double h, double fastest, const Matrix& K, const Matrix& C, const Matrix& G,
                     const std::vector<Variable>& variables, Matrix& W, Matrix& V) {
  if (!(h > 0)) return;
  const double pieces = std::max(1.0, std::ceil(h * fastest / longest));
  if (!variables.empty() || pieces <= 1) return series(h, K, C, G, variables, W, V);
  if (pieces <= few) {
    for (int i = 0; i < static_cast<int>(pieces); ++i) series(h / pieces, K, C, G, variables, W, V);
    return;
  }
  squared(h, std::ilogb(pieces) + 1, K, C, G, W, V);
}

void Variation::series(double h, const Matrix& K, const Matrix& C, const Matrix& G,
                       const std::vector<Variable>& variables, Matrix& W, Matrix& V) {
  w_ = W;
  v_ = V;
  along_w_.resize(std::max(along_w_.size(), variables.size() * most_terms));
  along_v_.resize(along_w_.size());
  int quiet = 0;
  for (int k = 0; k < most_terms && quiet < 2; ++k) {
    const double factor = h / (k + 1);
    next_w_ = factor * v_;
    next_v_.noalias() = -factor * K * w_;
    next_v_.noalias() -= factor * C * v_;
    if (k == 0 && G.size() > 0) next_v_ += factor * G;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const Variable& part = variables[i];
      const auto at = [&](int term) { return i * most_terms + static_cast<std::size_t>(term); };
      along_w_[at(k)].noalias() = part.directions.transpose() * w_;
      along_v_[at(k)].noalias() = part.directions.transpose() * v_;
      sum_.setZero(part.directions.cols(), W.cols());
      for (int j = 0; j <= k && j < static_cast<int>(part.T.size()); ++j) {
        const auto power = static_cast<std::size_t>(j);
        sum_.noalias() += part.T[power] * along_w_[at(k - j)];
        if (!part.B.empty()) sum_.noalias() += part.B[power] * along_v_[at(k - j)];
      }
      next_v_.noalias() -= factor * part.over_mass * sum_;
    }
    W += next_w_;
    V += next_v_;
    // Two in a row, since the terms of one of the two may vanish.
    const double size = W.cwiseAbs().maxCoeff() + V.cwiseAbs().maxCoeff();
    const double term = next_w_.cwiseAbs().maxCoeff() + next_v_.cwiseAbs().maxCoeff();
    quiet = term <= small * size ? quiet + 1 : 0;
    w_.swap(next_w_);
    v_.swap(next_v_);
  }
}

// The map of (w, w', G's columns as inputs) over h/2^halvings, squared as often.
void Variation::squared(double h, int halvings, const Matrix& K, const Matrix& C, const Matrix& G, Matrix& W,
                        Matrix& V) {
  const Eigen::Index n = W.rows(), inputs = G.size() > 0 ? n : 0, size = 2 * n + inputs;
  map_w_.setZero(n, size);
  map_v_.setZero(n, size);
  map_w_.leftCols(n).setIdentity();
  map_v_.middleCols(n, n).setIdentity();
  input_.setZero(inputs, size);
  input_.rightCols(inputs).setIdentity();
  series(std::ldexp(h, -halvings), K, C, input_, {}, map_w_, map_v_);
  map_.setZero(size, size);
  map_.topRows(n) = map_w_;
  map_.middleRows(n, n) = map_v_;
  map_.bottomRightCorner(inputs, inputs).setIdentity();
  for (int i = 0; i < halvings; ++i) {
    twice_.noalias() = map_ * map_;
    map_.swap(twice_);
  }
  state_.resize(size, W.cols());
  state_.topRows(n) = W;
  state_.middleRows(n, n) = V;
  if (inputs > 0) state_.bottomRows(n) = G;
  moved_.noalias() = map_ * state_;
  W = moved_.topRows(n);
  V = moved_.middleRows(n, n);
}

}  // namespace arcslip::time
