#include <arcslip/continuation/linear/lapack.hpp>

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <new>
#include <vector>

#include <dlfcn.h>
#include <sys/mman.h>

extern "C" {
// NOLINTBEGIN(readability-identifier-naming)
void dgetrf_(const int* m, const int* n, double* A, const int* lda, int* pivots, int* info);
void zgetrf_(const int* m, const int* n, std::complex<double>* A, const int* lda, int* pivots, int* info);
void dgemm_(const char* A_transposed, const char* B_transposed, const int* m, const int* n, const int* k,
            const double* alpha, const double* A, const int* lda, const double* B, const int* ldb,
            const double* beta, double* C, const int* ldc);
void dsyevd_(const char* job, const char* part, const int* n, double* A, const int* lda, double* values,
             double* work, const int* work_size, int* integers, const int* integers_size, int* info);
void dsygvd_(const int* type, const char* job, const char* part, const int* n, double* A, const int* lda,
             double* B, const int* ldb, double* values, double* work, const int* work_size, int* integers,
             const int* integers_size, int* info);
void dtrsm_(const char* side, const char* part, const char* transposed, const char* diagonal, const int* m,
            const int* n, const double* alpha, const double* A, const int* lda, double* B, const int* ldb);
void ztrsm_(const char* side, const char* part, const char* transposed, const char* diagonal, const int* m,
            const int* n, const std::complex<double>* alpha, const std::complex<double>* A, const int* lda,
            std::complex<double>* B, const int* ldb);
// NOLINTEND(readability-identifier-naming)
}

namespace arcslip::continuation::lapack {

namespace {

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

}  // namespace

// OpenBLAS built for one thread has buffers that its calls share: two at a time lose the values of each
// other. Only one that is built for several threads is known to keep them apart.
std::unique_lock<std::mutex> use() {
  require_memory();
  static std::mutex mutex;
  static const bool is_for_threads = [] {
    void* const found = ::dlsym(RTLD_DEFAULT, "openblas_get_parallel");
    return found != nullptr && reinterpret_cast<int (*)()>(found)() != 0;
  }();
  return is_for_threads ? std::unique_lock<std::mutex>() : std::unique_lock(mutex);
}

void factorize(int n, double* A, int* exchanges) {
  const auto in_use = use();
  int info = 0;
  dgetrf_(&n, &n, A, &n, exchanges, &info);
}

void factorize(int n, std::complex<double>* A, int* exchanges) {
  const auto in_use = use();
  int info = 0;
  zgetrf_(&n, &n, A, &n, exchanges, &info);
}

void solve_triangle(const char* part, const char* diagonal, int n, int columns, const double* A, double* B) {
  const auto in_use = use();
  const double one = 1;
  dtrsm_("L", part, "N", diagonal, &n, &columns, &one, A, &n, B, &n);
}

void solve_triangle(const char* part, const char* diagonal, int n, int columns, const std::complex<double>* A,
                    std::complex<double>* B) {
  const auto in_use = use();
  const std::complex<double> one = 1;
  ztrsm_("L", part, "N", diagonal, &n, &columns, &one, A, &n, B, &n);
}

void multiply(bool transposed, double alpha, const Columns& A, const Columns& B, double beta, double* C,
              int stride) {
  const auto in_use = use();
  const int m = transposed ? A.cols : A.rows;
  const auto at_least_one = [](int of) { return std::max(of, 1); };
  const int lda = at_least_one(A.stride), ldb = at_least_one(B.stride), ldc = at_least_one(stride);
  dgemm_(transposed ? "T" : "N", "N", &m, &B.cols, &B.rows, &alpha, A.data, &lda, B.data, &ldb, &beta, C,
         &ldc);
}

bool symmetric_modes(bool with_vectors, int n, double* A, double* B, double* values) {
  const auto in_use = use();
  const char* job = with_vectors ? "V" : "N";
  const int type = 1;
  int info = 0, integers_size = -1, work_size = -1;
  std::vector<double> work(1);
  std::vector<int> integers(1);
  const auto call = [&] {
    if (B == nullptr)
      dsyevd_(job, "L", &n, A, &n, values, work.data(), &work_size, integers.data(), &integers_size, &info);
    else
      dsygvd_(&type, job, "L", &n, A, &n, B, &n, values, work.data(), &work_size, integers.data(),
              &integers_size, &info);
  };
  call();
  work_size = static_cast<int>(work[0]);
  integers_size = integers[0];
  work.resize(static_cast<std::size_t>(work_size));
  integers.resize(static_cast<std::size_t>(integers_size));
  call();
  return info == 0;
}

}  // namespace arcslip::continuation::lapack
