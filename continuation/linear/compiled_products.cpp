// The products of compiled_products.hpp by Eigen. This file is compiled without the specialization in that
// header, and with types of its own, so that none of its functions is another one elsewhere.
#define ARCSLIP_PRODUCTS_OF_EIGEN
#include <arcslip/continuation/linear/compiled_products.hpp>

#include <utility>

#ifdef ARCSLIP_VECTOR_KERNELS
ARCSLIP_VECTOR_KERNELS()
#endif

namespace arcslip::continuation {
namespace {

template <int spacing>
struct Apart : Eigen::Stride<Eigen::Dynamic, spacing> {
  explicit Apart(Eigen::Index columns = 0) : Eigen::Stride<Eigen::Dynamic, spacing>(columns, spacing) {}
  Apart(Eigen::Index columns, Eigen::Index) : Apart(columns) {}
};

template <class Matrix, int spacing = 1>
using InMemory = Eigen::Map<Matrix, 0, Apart<spacing>>;

template <class Scalar>
using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

template <bool transposed, class Matrix>
auto op(const Matrix& of) {
  if constexpr (transposed)
    return of.transpose();
  else
    return of;
}

template <class C, class A, class B>
void multiply_into(Into into, C& c, const A& a, const B& b) {
  switch (into) {
    case Into::assign:
      c.noalias() = a * b;
      break;
    case Into::add:
      c.noalias() += a * b;
      break;
    case Into::subtract:
      c.noalias() -= a * b;
      break;
  }
}

}  // namespace

template <class Scalar, class Left, bool left_transposed, class Right, bool right_transposed, int spacing>
void multiply(Into into, bool small, Scalar factor, const Columns<Left>& A, const Columns<Right>& B,
              Scalar* C, Eigen::Index stride) {
  const InMemory<const Dense<Left>> left(A.data, A.rows, A.cols, Apart<1>(A.stride));
  const InMemory<const Dense<Right>> right(B.data, B.rows, B.cols, Apart<1>(B.stride));
  const auto a = op<left_transposed>(left);
  const auto b = op<right_transposed>(right);
  InMemory<Dense<Scalar>, spacing> c(C, a.rows(), b.cols(), Apart<spacing>(stride));
  using Product = Eigen::internal::generic_product_impl<std::remove_const_t<decltype(a)>,
                                                        std::remove_const_t<decltype(b)>, Eigen::DenseShape,
                                                        Eigen::DenseShape, Eigen::GemmProduct>;
  if (!small)
    Product::scaleAndAddTo(c, a, b, factor);
  else if (Eigen::NumTraits<Scalar>::IsComplex && factor == Scalar(1))  // which is not exact
    multiply_into(into, c, a, b);
  else if constexpr (std::is_same_v<Scalar, Left>)
    multiply_into(into, c, factor * a, b);
  else if (std::imag(factor) == 0)
    multiply_into(into, c, std::real(factor) * a, b);
  else
    multiply_into(into, c, a, factor * b);
}

#define ARCSLIP_MULTIPLY(Scalar, Left, left_transposed, Right, right_transposed, spacing)  \
  template void multiply<Scalar, Left, left_transposed, Right, right_transposed, spacing>( \
      Into, bool, Scalar, const Columns<Left>&, const Columns<Right>&, Scalar*, Eigen::Index);
using Real = double;
using Complex = std::complex<double>;
ARCSLIP_MULTIPLY(Real, Real, false, Real, false, 1)
ARCSLIP_MULTIPLY(Real, Real, false, Real, true, 1)
ARCSLIP_MULTIPLY(Real, Real, true, Real, false, 1)
ARCSLIP_MULTIPLY(Real, Real, true, Real, true, 1)
ARCSLIP_MULTIPLY(Complex, Complex, false, Complex, false, 1)
ARCSLIP_MULTIPLY(Complex, Complex, false, Complex, true, 1)
ARCSLIP_MULTIPLY(Complex, Complex, true, Complex, false, 1)
ARCSLIP_MULTIPLY(Complex, Complex, true, Complex, true, 1)
ARCSLIP_MULTIPLY(Complex, Real, false, Complex, false, 1)
ARCSLIP_MULTIPLY(Complex, Real, false, Complex, true, 1)
ARCSLIP_MULTIPLY(Complex, Real, true, Complex, false, 1)
ARCSLIP_MULTIPLY(Complex, Real, true, Complex, true, 1)
ARCSLIP_MULTIPLY(Complex, Complex, false, Real, false, 1)
ARCSLIP_MULTIPLY(Complex, Complex, false, Real, true, 1)
ARCSLIP_MULTIPLY(Complex, Complex, true, Real, false, 1)
ARCSLIP_MULTIPLY(Complex, Complex, true, Real, true, 1)
ARCSLIP_MULTIPLY(Real, Real, true, Real, false, 2)  // into real or imaginary parts
#undef ARCSLIP_MULTIPLY

}  // namespace arcslip::continuation
