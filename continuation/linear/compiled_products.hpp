#pragma once
// Products of dense matrices of any size, compiled once.
//
// Eigen compiles each product C = A B, C += A B, C -= A B anew for each type of A, B and C (a matrix, a
// block, a transpose, a sum), with its paths for small and large sizes and for vectors: half of the time that
// this library took to compile. Here those with scalars double or complex<double> are handed to one function,
// which takes the operands as columns in memory and calls Eigen for them: the same operations in the same
// order, but where an operand has a factor and the product a single entry, whose last digit may differ. Other
// operands that are expressions are evaluated first, as Eigen does.
//
// The build puts this header before each of its files. It is not installed: a program that includes public
// headers has the products of Eigen. All that is defined here is inlined into functions of Eigen, of which a
// program may have a copy with and one without it: the tests hold the two to the same values.

#include <Eigen/Core>

#include <complex>
#include <type_traits>

namespace arcslip::continuation {

/// A matrix as its columns in memory, or the transpose of such a matrix.
template <class Scalar>
struct Columns {
  const Scalar* data;
  Eigen::Index rows, cols, stride;  // of the matrix in memory
};

enum class Into { assign, add, subtract };

/// C = (factor A) B, C += (factor A) B, C -= (factor A) B, with op A in place of A where it is transposed,
/// and op B; C: op A rows x op B columns, its columns `stride` apart, the entries of a column `spacing`.
/// Small: whether small sizes may be computed entry by entry.
template <class Scalar, class Left, bool left_transposed, class Right, bool right_transposed, int spacing = 1>
void multiply(Into into, bool small, Scalar factor, const Columns<Left>& A, const Columns<Right>& B,
              Scalar* C, Eigen::Index stride);

}  // namespace arcslip::continuation

#if EIGEN_WORLD_VERSION == 3 && EIGEN_MAJOR_VERSION == 4  // whose internals these are

// Kernels of Eigen for a matrix times a vector and for triangular matrices. They are in one file, too: of
// several copies the linker would take one, which may be of a file that is not optimised for speed.
#define ARCSLIP_MATRIX_VECTOR(keyword, Scalar, left, right)                                            \
  keyword template struct Eigen::internal::general_matrix_vector_product<                              \
      Eigen::Index, Scalar, Eigen::internal::const_blas_data_mapper<Scalar, Eigen::Index, left>, left, \
      false, Scalar, Eigen::internal::const_blas_data_mapper<Scalar, Eigen::Index, right>, false>;
#define ARCSLIP_TRIANGULAR(keyword, part, order)                                                 \
  keyword template struct Eigen::internal::triangular_solve_vector<double, double, Eigen::Index, \
                                                                   Eigen::OnTheLeft, part, false, order>;
#define ARCSLIP_VECTOR_KERNELS(keyword)                                                  \
  ARCSLIP_MATRIX_VECTOR(keyword, double, Eigen::RowMajor, Eigen::ColMajor)               \
  ARCSLIP_MATRIX_VECTOR(keyword, double, Eigen::ColMajor, Eigen::RowMajor)               \
  ARCSLIP_MATRIX_VECTOR(keyword, double, Eigen::ColMajor, Eigen::ColMajor)               \
  ARCSLIP_MATRIX_VECTOR(keyword, std::complex<double>, Eigen::RowMajor, Eigen::ColMajor) \
  ARCSLIP_TRIANGULAR(keyword, Eigen::Lower | Eigen::UnitDiag, Eigen::ColMajor)           \
  ARCSLIP_TRIANGULAR(keyword, Eigen::Upper, Eigen::ColMajor)                             \
  ARCSLIP_TRIANGULAR(keyword, Eigen::Upper | Eigen::UnitDiag, Eigen::RowMajor)           \
  ARCSLIP_TRIANGULAR(keyword, Eigen::Lower, Eigen::RowMajor)
ARCSLIP_VECTOR_KERNELS(extern)

#ifndef ARCSLIP_PRODUCTS_OF_EIGEN

namespace Eigen::internal {

template <class Scalar>
inline constexpr bool is_multiplied_by_arcslip =
    std::is_same_v<Scalar, double> || std::is_same_v<Scalar, std::complex<double>>;

// An operand whose numbers of rows and columns are known at run time alone.
template <class Operand>
inline constexpr bool has_columns_for_arcslip =
    is_multiplied_by_arcslip<typename Operand::Scalar> && Operand::RowsAtCompileTime == Dynamic &&
    Operand::ColsAtCompileTime == Dynamic && Operand::MaxRowsAtCompileTime == Dynamic &&
    Operand::MaxColsAtCompileTime == Dynamic && !bool(blas_traits<Operand>::NeedToConjugate);

template <class Lhs, class Rhs>
  requires has_columns_for_arcslip<Lhs> && has_columns_for_arcslip<Rhs>
struct generic_product_impl<Lhs, Rhs, DenseShape, DenseShape, GemmProduct> {
  using Scalar = typename Product<Lhs, Rhs>::Scalar;
  using Into = arcslip::continuation::Into;

  template <class Dst>
  EIGEN_ALWAYS_INLINE static void evalTo(Dst& dst, const Lhs& lhs, const Rhs& rhs) {
    multiply(Into::assign, true, dst, lhs, rhs, Scalar(1));
  }
  template <class Dst>
  EIGEN_ALWAYS_INLINE static void addTo(Dst& dst, const Lhs& lhs, const Rhs& rhs) {
    multiply(Into::add, true, dst, lhs, rhs, Scalar(1));
  }
  template <class Dst>
  EIGEN_ALWAYS_INLINE static void subTo(Dst& dst, const Lhs& lhs, const Rhs& rhs) {
    multiply(Into::subtract, true, dst, lhs, rhs, Scalar(1));
  }
  template <class Dst>
  EIGEN_ALWAYS_INLINE static void scaleAndAddTo(Dst& dst, const Lhs& lhs, const Rhs& rhs,
                                                const Scalar& factor) {
    multiply(Into::add, false, dst, lhs, rhs, factor);
  }

 private:
  template <class Traits>
  using Evaluated = typename add_const_on_value_type<typename Traits::DirectLinearAccessType>::type;

  template <class Direct>
  EIGEN_ALWAYS_INLINE static arcslip::continuation::Columns<typename Direct::Scalar> columns(
      const Direct& of) {
    if constexpr (bool(Direct::IsRowMajor))
      return {of.data(), of.cols(), of.rows(), of.outerStride()};
    else
      return {of.data(), of.rows(), of.cols(), of.outerStride()};
  }

  template <class Dst>
  EIGEN_ALWAYS_INLINE static void multiply(Into into, bool small, Dst& dst, const Lhs& lhs, const Rhs& rhs,
                                           const Scalar& factor) {
    using Left = typename remove_all<typename blas_traits<Lhs>::DirectLinearAccessType>::type;
    using Right = typename remove_all<typename blas_traits<Rhs>::DirectLinearAccessType>::type;
    constexpr int spacing = Dst::InnerStrideAtCompileTime;  // 2: of real or imaginary parts
    const Evaluated<blas_traits<Lhs>> A = blas_traits<Lhs>::extract(lhs);
    const Evaluated<blas_traits<Rhs>> B = blas_traits<Rhs>::extract(rhs);
    const Scalar all = combine_scalar_factors(factor, lhs, rhs);
    constexpr bool left = bool(Left::IsRowMajor), right = bool(Right::IsRowMajor);
    using L = typename Left::Scalar;
    using R = typename Right::Scalar;
    if constexpr (bool(Dst::IsRowMajor))  // C^T = B^T A^T
      arcslip::continuation::multiply<Scalar, R, !right, L, !left, spacing>(
          into, small, all, columns(B), columns(A), dst.data(), dst.outerStride());
    else
      arcslip::continuation::multiply<Scalar, L, left, R, right, spacing>(
          into, small, all, columns(A), columns(B), dst.data(), dst.outerStride());
  }
};

}  // namespace Eigen::internal

#endif

#endif
