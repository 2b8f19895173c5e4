#include <arcslip/continuation/linear/compiled_products.hpp>

#include "catch.hpp"
#include "continuation/linear/products_of_eigen.hpp"

#include <complex>
#include <cstring>

namespace {

using Complex = std::complex<double>;

template <class Scalar>
using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

static_assert(Eigen::internal::has_columns_for_arcslip<Eigen::Transpose<Dense<double>>>);
static_assert(Eigen::internal::has_columns_for_arcslip<Eigen::Block<Dense<Complex>>>);
static_assert(!Eigen::internal::has_columns_for_arcslip<Eigen::Matrix2d>);

template <class Scalar>
bool same_bits(const Dense<Scalar>& a, const products_of_eigen::Matrix<Scalar>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(Scalar) * static_cast<std::size_t>(a.size())) == 0;
}

// The product that is compiled once, next to that of Eigen: `into` as there.
template <class Left, class Right, class A, class B>
bool agrees(int into, Left factor, bool left_transposed, const A& a, const Dense<Left>& in_a,
            bool right_transposed, const B& b, const Dense<Right>& in_b) {
  using Scalar = typename Eigen::ScalarBinaryOpTraits<Left, Right>::ReturnType;
  Dense<Scalar> C = Dense<Scalar>::Random(a.rows(), b.cols());
  products_of_eigen::Matrix<Scalar> expected = C;
  const auto set = [&](const auto& scaled) {
    if (into == 0) C.noalias() = scaled * b;
    if (into == 1) C.noalias() += scaled * b;
    if (into == 2) C.noalias() -= scaled * b;
  };
  if (factor == Left(1))
    set(a);
  else
    set(factor * a);
  products_of_eigen::multiply<Scalar, Left, Right>(into, factor, left_transposed, in_a, right_transposed,
                                                   in_b, expected);
  return same_bits(C, expected);
}

template <class Left, class Right>
int disagreements(int rows, int depth, int columns) {
  const Dense<Left> A = Dense<Left>::Random(rows, depth), A_t = A.transpose();
  const Dense<Right> B = Dense<Right>::Random(depth, columns), B_t = B.transpose();
  Dense<Left> larger = Dense<Left>::Random(rows + 3, depth + 2);
  larger.block(1, 1, rows, depth) = A;
  int found = 0;
  for (int into = 0; into < 3; ++into)
    for (const Left factor : {Left(1.0), Left(-0.7)}) {
      found += !agrees<Left, Right>(into, factor, false, A, A, false, B, B);
      found += !agrees<Left, Right>(into, factor, true, A_t.transpose(), A_t, false, B, B);
      found += !agrees<Left, Right>(into, factor, false, larger.block(1, 1, rows, depth), A, false, B, B);
      found += !agrees<Left, Right>(into, factor, false, A, A, true, B_t.transpose(), B_t);
      found += !agrees<Left, Right>(into, factor, true, A_t.transpose(), A_t, true, B_t.transpose(), B_t);
    }
  return found;
}

}  // namespace

TEST_CASE("products that are compiled once have the bits of Eigen's") {
  for (const int rows : {1, 2, 5, 7, 16, 33})
    for (const int depth : {1, 2, 3, 8, 19, 40})
      for (const int columns : {1, 2, 6, 9, 32}) {
        CAPTURE(rows, depth, columns);
        CHECK(disagreements<double, double>(rows, depth, columns) == 0);
        CHECK(disagreements<Complex, Complex>(rows, depth, columns) == 0);
        CHECK(disagreements<double, Complex>(rows, depth, columns) == 0);
        CHECK(disagreements<Complex, double>(rows, depth, columns) == 0);
      }
}

TEST_CASE("a product of no depth is zero, and one of no rows or columns nothing") {
  CHECK((Dense<double>(3, 0) * Dense<double>(0, 2)).eval() == Dense<double>::Zero(3, 2));
  CHECK((Dense<double>(0, 4) * Dense<double>::Random(4, 2)).eval().rows() == 0);
  Dense<double> C = Dense<double>::Ones(3, 2);
  C.noalias() -= Dense<double>(3, 0) * Dense<double>(0, 2);
  CHECK(C == Dense<double>::Ones(3, 2));
}

TEST_CASE("a real product goes into the real and the imaginary parts of a complex matrix") {
  const Dense<double> A = Dense<double>::Random(30, 8), B = Dense<double>::Random(30, 5);
  Dense<Complex> C = Dense<Complex>::Random(8, 5);
  const Dense<Complex> before = C;
  C.real().noalias() -= A.transpose() * B;
  const Dense<double> AB = A.transpose() * B;
  CHECK((C.real() - (before.real() - AB)).cwiseAbs().maxCoeff() == 0);
  CHECK(C.imag() == before.imag());
}

TEST_CASE("products into rows, of sums and of products are those of their values") {
  const Dense<double> A = Dense<double>::Random(9, 7), B = Dense<double>::Random(7, 6),
                      D = Dense<double>::Random(6, 9);
  const Dense<double> AB = A * B, sum = A + 2 * A, ABD = AB * D, sum_B = sum * B;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_rows = A * B;
  CHECK(by_rows == AB);
  CHECK(Dense<double>(A * B * D) == ABD);
  CHECK(Dense<double>((A + 2 * A) * B) == sum_B);
  const Dense<Complex> E = Dense<Complex>::Random(7, 6);
  CHECK((Dense<Complex>(A.cast<Complex>() * E) - A * E).cwiseAbs().maxCoeff() < 1e-14);
}
