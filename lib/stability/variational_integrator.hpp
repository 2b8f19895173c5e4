#pragma once
// Pieces of the variational equation by power series (floquet.hpp). Private.
//
//   w'' = -C w' - K w + G - sum_j s^j D (T_j D^T w + B_j D^T w' + E_j D^T w'' + p_j y),     0 <= s <= 1
//   y'  = sum_j s^j (R_j y + Q_j D^T w)
//
// over an angle h, with a small E, whose square is left out; C, K, D: with M^-1 and the powers of omega in
// them. Several w run together: a row for each, a column for each degree of freedom; a sparse K costs its
// nonzeros.

#include <arcslip/time/equation/equation_of_motion.hpp>

#include <vector>

namespace arcslip::time {

/// Coefficients that change over the piece.
struct Variable {
  /// over_mass, along: M^-1 D and D, dofs x directions; moving: with B.
  Variable(const Matrix& over_mass, const Matrix& along, Eigen::Index powers, bool moving);

  struct Entry {
    Eigen::Index dof, direction;
    double weight;
  };
  Eigen::Index directions;
  std::vector<Entry> onto, from;       // of M^-1 D and D, without zeros, column by column
  std::vector<std::size_t> from_ends;  // of the columns
  Matrix T, B, E;                      // of s^j, directions x directions, side by side; B and E may be empty
  Matrix by_memory;                    // p_j, directions x numbers in y, side by side; empty: 0
  Matrix memory;                       // y, a row for each w
  Matrix decay, rate_by_q;             // R_j and Q_j, side by side; empty: y is constant
  double size;                         // |M^-1 D| |D|
};

class Variation {
 public:
  /// G: as W, constant; empty: 0.
  void set(const Matrix& K, const Matrix& C, const Matrix& G);
  /// Moves W, its derivative V and the memories of the variables by h. fastest: an upper bound of the
  /// frequencies of the piece without the variables, rad/rad. With these, h is a few rad of the fastest
  /// motion at most, their coefficients of s^j taken with their sizes.
  void move(double h, double fastest, std::vector<Variable>& variables, Matrix& W, Matrix& V);
  void move(double h, double fastest, Matrix& W, Matrix& V) { move(h, fastest, none_, W, V); }
  /// w'' at the end of the piece, s = 1, without E.
  Matrix acceleration(const std::vector<Variable>& variables, const Matrix& W, const Matrix& V) const;

 private:
  struct Entry {
    Eigen::Index column;
    double k, c;
  };
  // Several w side by side.
  struct Buffers {
    std::vector<double> w, v, next_w, next_v, sum_w, sum_v;  // of each degree of freedom
    struct Along {
      std::vector<double> w, v, a, sum;        // the terms so far along D; of each direction
      std::vector<double> memory, memory_sum;  // its terms so far, and their sum
    };
    std::vector<Along> along;  // of each variable
  };

  std::size_t terms_of(double h, double fastest, const std::vector<Variable>& variables);
  void series(double h, std::size_t terms, const Matrix& G, std::vector<Variable>& variables, Matrix& W,
              Matrix& V);
  void series_from(Eigen::Index start, double h, std::size_t terms, const Matrix& G,
                   std::vector<Variable>& variables, Matrix& W, Matrix& V);
  void add_terms(std::size_t terms, double h, const std::vector<Variable>& variables);
  void squared(double h, double fastest, int halvings, Matrix& W, Matrix& V);

  std::vector<Entry> entries_;     // of K and C, without zeros, row by row
  std::vector<std::size_t> rows_;  // where each begins; and the end
  Matrix G_;
  Buffers at_;
  std::vector<double> by_w_, by_v_, by_y_, y_by_y_, y_by_w_, size_w_, size_v_, size_y_;  // of sizes of terms
  std::vector<Variable> none_;
  Matrix map_, twice_, map_w_, map_v_, input_, state_, moved_;
};

}  // namespace arcslip::time
