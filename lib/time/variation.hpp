#pragma once
// Pieces of the variational equation by power series (floquet.hpp). Private.
//
//   w'' = -C w' - K w + G - sum_j s^j D (T_j D^T w + B_j D^T w'),     0 <= s <= 1
//
// over an angle h; C, K, D: with M^-1 and the powers of omega in them.

#include <arcslip/time/equation_of_motion.hpp>

#include <vector>

namespace arcslip::time {

/// Coefficients that change over the piece.
struct Variable {
  Matrix over_mass, directions;  // dofs x directions: M^-1 D/omega^2, D
  std::vector<Matrix> T, B;      // of s^j
};

class Variation {
 public:
  /// Moves w and its derivative by h. G: as w, constant. fastest: of the piece, in radians per radian.
  void move(double h, double fastest, const Matrix& K, const Matrix& C, const Matrix& G,
            const std::vector<Variable>& variables, Matrix& W, Matrix& V);

 private:
  void series(double h, const Matrix& K, const Matrix& C, const Matrix& G,
              const std::vector<Variable>& variables, Matrix& W, Matrix& V);
  void squared(double h, int halvings, const Matrix& K, const Matrix& C, const Matrix& G, Matrix& W,
               Matrix& V);

  Matrix w_, v_, next_w_, next_v_;              // terms
  std::vector<Matrix> along_w_, along_v_;       // D^T of the terms so far, of all variables
  Matrix sum_;                                  // of one variable
  Matrix map_, twice_, map_w_, map_v_, input_;  // of a short piece
  Matrix state_, moved_;
};

}  // namespace arcslip::time
