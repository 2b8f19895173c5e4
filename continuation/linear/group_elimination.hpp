#pragma once
// The equations of a dense bordered matrix that contain only unknowns of one group, eliminated ahead of the
// others. Unknowns in groups are, for example, coefficients of a periodic motion, a group for each harmonic:
// an equation of a coordinate on which only linear forces act, or a contact that sticks all along, couples no
// harmonics. With L_g such equations of the group g and their unknowns, and N all others, the borders among
// them,
//
//   [ A_g   W_g ] [x_Lg]   [f_Lg]      X_g = A_g^-1 W_g,   S = M - sum_g B_g X_g
//   [ B_g   M   ] [x_N ] = [f_N ]      S x_N = f_N - sum_g B_g A_g^-1 f_Lg,   x_Lg = A_g^-1 f_Lg - X_g x_N
//
// where W_g has columns of the group and of the borders alone. An LU of S costs |N|^3 in place of n^3.

#include <arcslip/continuation/problem/linear_solver.hpp>

#include <vector>

namespace arcslip::continuation {

/// Not thread-safe. Does not allocate once it has seen a matrix of its size.
class GroupElimination {
 public:
  /// The group of each unknown, 0 and more; empty: nothing is ever eliminated.
  explicit GroupElimination(const std::vector<int>& groups);

  /// Finds what can be eliminated from this matrix and does it. False: nothing, and J is to be solved with as
  /// it is. Throws std::invalid_argument if J has not as many unknowns as are in groups.
  bool eliminate(const Matrix& J, const Borders& borders);
  /// Unknowns that are left, without the borders.
  Eigen::Index kept() const { return static_cast<Eigen::Index>(kept_.size()); }
  /// S, of kept() + m rows and columns, the borders last.
  void form(const Matrix& J, const Borders& borders, Eigen::Ref<Matrix> S) const;
  /// Sign of the product of all det A_g.
  int determinant_sign() const { return sign_; }

  /// From f, n + m, the right-hand side of S; and with x_N the rest of x, in place of f.
  void reduce(In f, Out f_N) const;
  void expand(In x_N, Out x) const;
  /// The same with the transposed matrix.
  void reduce_transposed(In f, Out f_N) const;
  void expand_transposed(In x_N, Out x) const;

 private:
  struct Group {
    std::vector<int> all;               // its unknowns
    std::vector<int> eliminated, kept;  // of them
    Eigen::Index first_kept = 0;        // among all that are kept
    std::vector<double> A, X, B;        // A_g in factors, X_g, and B_g transposed: a column for each row of S
    std::vector<int> order, work;       // of the rows of A_g
    mutable Vector y;                   // of what is eliminated

    Eigen::Index size() const { return static_cast<Eigen::Index>(eliminated.size()); }
    Eigen::Index width() const { return static_cast<Eigen::Index>(kept.size()); }
  };
  bool may_pay(const Matrix& J) const;
  void resize(Eigen::Index n, Eigen::Index m);
  bool classify(const Matrix& J);
  bool factorize(Group& group, const Matrix& J, const Borders& borders);
  void gather_rows(Group& group, const Matrix& J, const Borders& borders);
  void take_sign(Group& group);
  void solve(const Group& group) const;  // y = A_g^-1 y

  std::vector<int> of_;  // the group of each unknown
  std::vector<Group> groups_;
  std::vector<int> kept_;
  Matrix others_;        // n x groups: 1 for an unknown of another group, 0 for one of this group
  Vector outside_;       // of each row of J, the sum of the magnitudes in columns of other groups
  Eigen::Index m_ = -1;  // borders
  int sign_ = 1;
};

}  // namespace arcslip::continuation
