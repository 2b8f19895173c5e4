#include <arcslip/continuation/linear/lapack.hpp>

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <new>

#include <sys/mman.h>

extern "C" {
// NOLINTBEGIN(readability-identifier-naming)
void dgetrf_(const int* m, const int* n, double* A, const int* lda, int* pivots, int* info);
void zgetrf_(const int* m, const int* n, std::complex<double>* A, const int* lda, int* pivots, int* info);
void dgemm_(const char* A_transposed, const char* B_transposed, const int* m, const int* n, const int* k,
            const double* alpha, const double* A, const int* lda, const double* B, const int* ldb,
            const double* beta, double* C, const int* ldc);
void dtrsm_(const char* side, const char* part, const char* transposed, const char* diagonal, const int* m,
            const int* n, const double* alpha, const double* A, const int* lda, double* B, const int* ldb);
void ztrsm_(const char* side, const char* part, const char* transposed, const char* diagonal, const int* m,
            const int* n, const std::complex<double>* alpha, const std::complex<double>* A, const int* lda,
            std::complex<double>* B, const int* ldb);
// NOLINTEND(readability-identifier-naming)
}

namespace arcslip::continuation::lapack {

void require_memory() {
  static std::once_flag known;
  std::call_once(known, [] {
    constexpr std::size_t bytes = std::size_t{168} << 20;  // it takes 128 MB
    void* const memory =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    ::munmap(memory, bytes);
  });
}

void factorize(int n, double* A, int* exchanges) {
  require_memory();
  int info = 0;
  dgetrf_(&n, &n, A, &n, exchanges, &info);
}

void factorize(int n, std::complex<double>* A, int* exchanges) {
  require_memory();
  int info = 0;
  zgetrf_(&n, &n, A, &n, exchanges, &info);
}

void solve_triangle(const char* part, const char* diagonal, int n, int columns, const double* A, double* B) {
  const double one = 1;
  dtrsm_("L", part, "N", diagonal, &n, &columns, &one, A, &n, B, &n);
}

void solve_triangle(const char* part, const char* diagonal, int n, int columns, const std::complex<double>* A,
                    std::complex<double>* B) {
  const std::complex<double> one = 1;
  ztrsm_("L", part, "N", diagonal, &n, &columns, &one, A, &n, B, &n);
}

void transposed_product(int m, int n, int k, const double* A, const double* B, double* C) {
  require_memory();
  const int rows = std::max(k, 1), rows_of_C = std::max(m, 1);
  const double one = 1, zero = 0;
  dgemm_("T", "N", &m, &n, &k, &one, A, &rows, B, &rows, &zero, C, &rows_of_C);
}

}  // namespace arcslip::continuation::lapack
