#pragma once
// Products as Eigen compiles them, in a file that does not see compiled_products.hpp. Their matrices are of
// types of their own, so that no function here is one of the tests.

#include <Eigen/Core>

namespace products_of_eigen {

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::DontAlign>;

/// C = (factor op A) op B for into = 0, C += for 1, C -= for 2.
template <class Scalar, class Left, class Right>
void multiply(int into, Left factor, bool left_transposed, const Matrix<Left>& A, bool right_transposed,
              const Matrix<Right>& B, Matrix<Scalar>& C);

}  // namespace products_of_eigen
