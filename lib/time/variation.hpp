#pragma once
// Pieces of the variational equation by power series (floquet.hpp). Private.
//
//   w'' = -C w' - K w + G - sum_j s^j D (T_j D^T w + B_j D^T w' + p_j y),     0 <= s <= 1
//
// over an angle h, with a constant y; C, K, D: with M^-1 and the powers of omega in them. Several w run
// together: a row for each, a column for each degree of freedom, so that a sparse K costs its nonzeros.

#include <arcslip/time/equation_of_motion.hpp>

#include <vector>

namespace arcslip::time {

/// Coefficients that change over the piece.
struct Variable {
  /// over_mass, along: M^-1 D and D, dofs x directions; moving: with B.
  Variable(const Matrix& over_mass, const Matrix& along, std::size_t powers, bool moving);

  struct Entry {
    Eigen::Index dof, direction;
    double weight;
  };
  std::vector<Entry> onto, from;  // of M^-1 D and D, without zeros
  std::vector<Matrix> T, B;       // of s^j, directions x directions
  Matrix by_memory;               // p_j in column j, directions x powers; empty: 0
  Vector memory;                  // y, a number for each w
  double size;                    // |M^-1 D| |D|
};

class Variation {
 public:
  /// Moves W and its derivative V by h. G: as W, constant; empty: 0. fastest: an upper bound of the
  /// frequencies of the piece, rad/rad; h fastest <= 2 where coefficients change.
  void move(double h, double fastest, const Matrix& K, const Matrix& C, const Matrix& G,
            const std::vector<Variable>& variables, Matrix& W, Matrix& V);

 private:
  struct Entry {
    Eigen::Index column;
    double k, c;
  };

  void take(const Matrix& K, const Matrix& C);
  void series(double h, double fastest, const Matrix& G, const std::vector<Variable>& variables, Matrix& W,
              Matrix& V);
  void squared(double h, double fastest, int halvings, const Matrix& G, Matrix& W, Matrix& V);

  void add_variable(const Variable& variable, std::size_t k, Matrix& along_w, Matrix& along_v);

  std::vector<std::vector<Entry>> rows_;  // of K and C, without zeros
  Matrix w_, v_, next_w_, next_v_;        // terms
  std::vector<Matrix> along_w_,
      along_v_;  // of each variable, the terms so far along D: starts x directions each
  Matrix sum_;   // of one variable
  Matrix map_, twice_, map_w_, map_v_, input_, state_, moved_;
};

}  // namespace arcslip::time
