#include "continuation/linear/products_of_eigen.hpp"

#include <complex>

namespace products_of_eigen {
namespace {

template <class C, class A, class B>
void multiply_into(int into, C& c, const A& a, const B& b) {
  if (into == 0) c.noalias() = a * b;
  if (into == 1) c.noalias() += a * b;
  if (into == 2) c.noalias() -= a * b;
}

template <class Factor, class C, class A, class B>
void scaled(int into, Factor factor, C& c, const A& a, const B& b) {
  if (factor == Factor(1))
    multiply_into(into, c, a, b);
  else
    multiply_into(into, c, factor * a, b);
}

}  // namespace

template <class Scalar, class Left, class Right>
void multiply(int into, Left factor, bool left_transposed, const Matrix<Left>& A, bool right_transposed,
              const Matrix<Right>& B, Matrix<Scalar>& C) {
  if (left_transposed && right_transposed) scaled(into, factor, C, A.transpose(), B.transpose());
  if (left_transposed && !right_transposed) scaled(into, factor, C, A.transpose(), B);
  if (!left_transposed && right_transposed) scaled(into, factor, C, A, B.transpose());
  if (!left_transposed && !right_transposed) scaled(into, factor, C, A, B);
}

using Complex = std::complex<double>;
template void multiply(int, double, bool, const Matrix<double>&, bool, const Matrix<double>&,
                       Matrix<double>&);
template void multiply(int, Complex, bool, const Matrix<Complex>&, bool, const Matrix<Complex>&,
                       Matrix<Complex>&);
template void multiply(int, double, bool, const Matrix<double>&, bool, const Matrix<Complex>&,
                       Matrix<Complex>&);
template void multiply(int, Complex, bool, const Matrix<Complex>&, bool, const Matrix<double>&,
                       Matrix<Complex>&);

}  // namespace products_of_eigen
