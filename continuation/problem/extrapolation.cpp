#include <arcslip/continuation/problem/extrapolation.hpp>

#include <limits>
#include <utility>

namespace arcslip::continuation {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double getting_worse = 4;  // of an estimate, as rounding takes over

}  // namespace

ExtrapolationTable::ExtrapolationTable(Eigen::Index rows)
    : best_{Vector::Zero(rows), Vector::Constant(rows, infinite)} {}

void ExtrapolationTable::restart() {
  columns_ = 0;
  before_.clear();
  best_.error.setConstant(infinite);
}

bool ExtrapolationTable::add(const Vector& quotient) {
  const Eigen::Index rows = quotient.size();
  row_.resize(columns_ + 1);
  row_[0] = quotient;
  Vector least = Vector::Constant(rows, infinite);
  double power = 1;
  for (std::size_t j = 1; j <= columns_; ++j) {
    power *= 4;
    row_[j] = row_[j - 1] + (row_[j - 1] - before_[j - 1]) / (power - 1);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const double now =
          std::max(std::abs(row_[j][i] - row_[j - 1][i]), std::abs(row_[j][i] - before_[j - 1][i]));
      least[i] = std::min(least[i], now);
      if (!(now < best_.error[i])) continue;
      best_.error[i] = now;
      best_.value[i] = row_[j][i];
    }
  }
  const bool improves = columns_ < 2 || (least.array() <= getting_worse * best_.error.array()).any();
  std::swap(row_, before_);
  ++columns_;
  return improves && best_.error.maxCoeff() > 0;
}

}  // namespace arcslip::continuation
