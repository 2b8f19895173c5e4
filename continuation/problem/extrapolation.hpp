#pragma once
// Difference quotients extrapolated to a step of zero (Ridders, Adv. Eng. Softw. 4, 1982). Not installed.
//
// A central quotient is D(h) = D + c_1 h^2 + c_2 h^4 + ..., so that with h_k = h_0 / 2^k
//
//   T_k0 = D(h_k),   T_kj = T_k,j-1 + (T_k,j-1 - T_k-1,j-1) / (4^j - 1)
//
// has an error of order 2j + 2. The larger distance of T_kj from the two that it is made of estimates its
// error; truncation shrinks with k and rounding grows, and each row of D takes the T_kj of the least
// estimate.

#include <arcslip/continuation/problem/problem.hpp>

#include <cmath>
#include <optional>
#include <vector>

namespace arcslip::continuation {

struct ExtrapolatedDifference {
  Vector value, error;  // error: estimated, of each row
};

/// The table of T_kj, row by row of D.
class ExtrapolationTable {
 public:
  explicit ExtrapolationTable(Eigen::Index rows);
  /// Forgets all quotients, as where the next one belongs to no half of the last step.
  void restart();
  /// Adds D(h_k). False: in every row rounding has taken over.
  bool add(const Vector& quotient);
  bool known() const { return best_.error.allFinite(); }
  const ExtrapolatedDifference& best() const { return best_; }

 private:
  ExtrapolatedDifference best_;
  std::vector<Vector> row_, before_;
  std::size_t columns_ = 0;
};

constexpr int extrapolated_steps = 10;  // of a table
constexpr int leaving_halvings = 24;    // of the first step, at most, until F is smooth across it

/// The limit of quotients by steps from h down. quotient(h, D) computes D(h) and returns false where it
/// cannot, as beyond the end of a piece. Nothing where two steps in a row never succeed.
template <class Quotient>
std::optional<ExtrapolatedDifference> extrapolate(Eigen::Index rows, double h, Quotient&& quotient) {
  ExtrapolationTable table(rows);
  Vector D(rows);
  for (int taken = 0, left = 0; taken < extrapolated_steps && left < leaving_halvings; h *= 0.5) {
    if (!quotient(h, D) || !D.allFinite()) {
      table.restart();
      taken = 0;
      ++left;
      continue;
    }
    ++taken;
    if (!table.add(D)) break;
  }
  return table.known() ? std::optional(table.best()) : std::nullopt;
}

}  // namespace arcslip::continuation
