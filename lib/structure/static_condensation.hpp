#pragma once
// A structure in (b, i) and what is condensed statically onto b and projected onto vectors V of the others,
// by which reduction.hpp describes it: x_i = Psi x_b + V z, A = K + sigma M, Psi = -A_ii^-1 A_ib.

#include <arcslip/structure/blocks.hpp>
#include <arcslip/structure/digit_loss.hpp>
#include <arcslip/structure/interior_factor.hpp>
#include <arcslip/structure/krylov_space.hpp>
#include <arcslip/structure/projected.hpp>
#include <arcslip/structure/reduction.hpp>

#include <optional>
#include <string>
#include <vector>

namespace arcslip::structure {

/// A matrix next to A, and its columns for x_b among the others: R = A_ii Psi + A_ib.
struct Operator {
  Blocks of;
  Eigen::MatrixXd R;
};

class StaticCondensation {
 public:
  /// control stays with the caller.
  StaticCondensation(const scene::Matrices& matrices, const std::vector<int>& kept, const Purpose& purpose,
                     const control::Control& control);

  /// Factorizes A_ii, condenses all onto b, and begins an empty V; where there are no others, b is all.
  void condense();

  Eigen::Index others() const { return parts_.others; }
  /// M, C, K2 and the skew-symmetric ones, as the parts of projected().
  const std::vector<Operator>& operators() const { return operators_; }
  const Eigen::MatrixXd& loads_of_others() const { return f_i_; }
  const InteriorFactor& factor() const { return factor_; }
  /// K + sigma M and M of all rows, in (b, i).
  Sparse whole_stiffness(double sigma) const;
  Sparse whole_mass() const { return whole(*matrices_.mass.matrix, parts_); }
  const Projected& projected() const { return P_; }
  EnergyBasis& space() { return *space_; }

  /// All that V's vectors from `old` on add to projected().
  void project_from(Eigen::Index old);
  /// The first vectors alone.
  void keep(Eigen::Index count);
  /// Vectors V Q in place of V, whose A V is not needed any more.
  void turn(const Eigen::MatrixXd& Q);
  /// All that can be: V of all others.
  void take_whole();

  /// What the last digits of the entries change, as far as the rows that are kept see it.
  Rounding rounding_of_entries() const;
  /// In the eigenvectors of M_zz, with `error` next to that of the entries.
  Reduced reduced(double error) const;

 private:
  void add_operator(PartOfZ part, const scene::SparseMatrix& A);
  void factorize();
  void condense_loads();
  void project(Reduced& into) const;
  [[noreturn]] void refuse_indefinite(const std::string& where) const;

  const double square_;             // of the speed of the expansion
  const scene::Matrices matrices_;  // symmetric parts
  const std::vector<Skew> skew_;
  const double accuracy_;  // of the structure in (b, z), as asked for
  const double sigma_;
  const Partition parts_;
  const Blocks K_;
  std::vector<Operator> operators_;
  Eigen::MatrixXd f_b_, f_i_;  // loads
  Sparse A_ii_;
  InteriorFactor factor_;
  Eigen::MatrixXd Psi_;
  std::optional<EnergyBasis> space_;
  Projected P_;
};

/// Gives V its vectors by purpose.method, Craig-Bampton or Rubin (component_modes.cpp). of: condensed, with
/// an empty V.
void take_modes(StaticCondensation& of, const Purpose& purpose, const control::Control& control);

[[noreturn]] void refuse(const std::string& cause);
[[noreturn]] void refuse_overflow();
/// Of statics, without sigma.
[[noreturn]] void refuse_floating();
/// A number with three digits, for messages.
std::string three_digits(double value);

}  // namespace arcslip::structure
