#pragma once
// Excitations on all rows of matrices from files. With S = real + i imaginary, a vector over the rows, and
// the amplitude A = cosine - i sine,
//
//   f(t) = Re(A S exp(i n w t))
//
// is the force of a pressure field, whose real and imaginary part a travelling wave has both. Of a motion of
// the ground S is r: the ground under row i moves by A S_i, as a rigid body in the row's direction, as a
// rule. Where the matrices have copies, it is on the rows of one of them.

#include <arcslip/scene/matrices.hpp>
#include <arcslip/scene/scene.hpp>

#include <vector>

namespace arcslip::scene {

/// A column of the matrix in a file, or none.
struct ShapeFile {
  MatrixFile from{};
  int column = 1;

  bool is_given() const { return !from.file.path.empty() || from.file.text != nullptr; }
  /// Its values by the rows. is_given(), and the matrix has the column.
  std::vector<double> values() const;
  friend bool operator==(const ShapeFile&, const ShapeFile&) = default;
};

struct Shape {
  ShapeFile real{}, imaginary{};
  int copy = 0;  // of the matrices, from 1; 0: not given
  friend bool operator==(const Shape&, const Shape&) = default;
};

/// The shape of an excitation; null: it has none.
const Shape* shape_of(const Part& excitation);

}  // namespace arcslip::scene
