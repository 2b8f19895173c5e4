// Time over the number of unknowns: Bratu's problem (examples/bratu) through its fold to lambda = 1, and
// where the time goes. Prints a table for gnuplot.
//
//   arcslip_bench_bratu [largest n = 1000000]

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/problem/functions.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace arcslip::continuation;

namespace {

struct Stopwatch {
  double seconds = 0;
  template <class Work>
  void time(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
};

struct Times {
  Stopwatch factorizations, solves, evaluations;
};

class Timed final : public LinearSolver {
 public:
  explicit Timed(Times& times) : times_(times) {}
  const char* name() const override { return solver_->name(); }
  bool factorize(const Jacobian& J, const Borders& borders) override {
    bool done = false;
    times_.factorizations.time([&] { done = solver_->factorize(J, borders); });
    return done;
  }
  void solve(Out x) const override {
    times_.solves.time([&] { solver_->solve(x); });
  }
  std::optional<int> determinant_sign() const override { return solver_->determinant_sign(); }

 private:
  Times& times_;
  std::unique_ptr<LinearSolver> solver_ = klu();
};

SparseMatrix second_difference(int n) {
  SparseMatrix J(n, n);
  J.reserve(Eigen::VectorXi::Constant(n, 3));
  for (int i = 0; i < n; ++i) {
    if (i > 0) J.insert(i - 1, i) = -1;
    J.insert(i, i) = 2;
    if (i + 1 < n) J.insert(i + 1, i) = -1;
  }
  J.makeCompressed();
  return J;
}

void measure(int n) {
  const double h = 1.0 / (n + 1);
  Times times;
  Functions bratu;
  bratu.size = n;
  bratu.parameters = {{"lambda", "", 0.1}};
  bratu.scales = Vector::Constant(n, std::sqrt(n));
  bratu.residual = [&, h](In u, In p, Out F) {
    times.evaluations.time([&] {
      for (int i = 0; i < n; ++i) {
        const double left = i > 0 ? u[i] - u[i - 1] : u[i], right = i + 1 < n ? u[i] - u[i + 1] : u[i];
        F[i] = left + right - h * h * p[0] * std::exp(u[i]);
      }
    });
  };
  bratu.sparse_jacobian = [&, h](In u, In p, SparseMatrix& J) {
    if (J.nonZeros() == 0) J = second_difference(n);
    times.evaluations.time([&] {
      for (int i = 0; i < n; ++i)
        J.valuePtr()[J.outerIndexPtr()[i] + (i > 0)] = 2 - h * h * p[0] * std::exp(u[i]);
    });
  };
  bratu.derivative = [&, h](In u, In, int, Out dF) {
    times.evaluations.time([&] { dF = -h * h * u.array().exp(); });
  };
  bratu.linear_solver = [&] { return std::make_unique<Timed>(times); };
  const auto problem = from_functions(std::move(bratu));

  Stopwatch all;
  Branch branch;
  all.time([&] {
    branch = trace(problem, {.u = Vector::Zero(n), .p = parameter_values(*problem)},
                   {.lower = 0, .upper = 4, .keep_points = false}, {fold_monitor()},
                   [](const Accepted& at, const Event*) {
                     return at.u.maxCoeff() < 2 || at.p[0] > 1;  // to lambda = 1 on the upper branch
                   });
  });
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const Counts& counts = branch.counts;
  std::printf("%8d %8.3f %6ld %6ld %6ld %12.3f %8.3f %12.3f %8.3f %10.1f %12.3e\n", n, all.seconds,
              counts.points, counts.factorizations, counts.solves, times.factorizations.seconds,
              times.solves.seconds, times.evaluations.seconds,
              all.seconds - times.factorizations.seconds - times.solves.seconds - times.evaluations.seconds,
              static_cast<double>(usage.ru_maxrss) / 1024,
              branch.events.empty() ? NAN : branch.events.front().point.parameter - 3.513830719125161);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 1000000;
  std::printf(
      "#      n  total s points factor solves    factors s  solves s  evaluate s   rest s  memory MB  "
      "error of fold\n");
  for (int n = 1000; n <= largest; n *= 10) measure(n);
}
