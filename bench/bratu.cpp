// Time over the number of unknowns: Bratu's problem (examples/bratu) through its fold, which is located, to
// lambda = 1 on the upper branch.
//
//   bratu/n:N
//
// Counters: points, factorizations and solves; the seconds of each part; error of the fold.

#include "measure.hpp"

#include <arcslip/continuation/linear/linear_solvers.hpp>
#include <arcslip/continuation/problem/problem_from_functions.hpp>
#include <arcslip/continuation/tracing/tracer.hpp>

#include <cmath>
#include <memory>
#include <optional>

using namespace arcslip::continuation;

namespace {

constexpr double exact_fold = 3.513830719125161;

struct Stopwatch {
  double seconds = 0;
  template <class Work>
  void time(const Work& work) {
    seconds += arcslip::bench::seconds(1, work);
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

void to_the_upper_branch(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
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

  Branch branch;
  arcslip::bench::measure(state, [&] {
    times = {};
    branch = trace(problem, {.u = Vector::Zero(n), .p = parameter_values(*problem)},
                   {.lower = 0, .upper = 4, .keep_points = false}, {fold_monitor()},
                   [](const Accepted& at, const Event*) {
                     return at.u.maxCoeff() < 2 || at.p[0] > 1;  // to lambda = 1 on the upper branch
                   });
  });
  if (branch.events.size() != 1) return state.SkipWithError("not one fold");
  state.counters["points"] = static_cast<double>(branch.counts.points);
  state.counters["factorizations"] = static_cast<double>(branch.counts.factorizations);
  state.counters["solves"] = static_cast<double>(branch.counts.solves);
  state.counters["factorizations_seconds"] = times.factorizations.seconds;
  state.counters["solves_seconds"] = times.solves.seconds;
  state.counters["evaluations_seconds"] = times.evaluations.seconds;
  state.counters["error"] = branch.events.front().point.parameter - exact_fold;
}
BENCHMARK(to_the_upper_branch)->Name("bratu")->ArgName("n")->RangeMultiplier(10)->Range(1'000, 100'000);
BENCHMARK(to_the_upper_branch)->Name("bratu")->ArgName("n")->Arg(1'000'000)->Iterations(1)->Repetitions(1);

}  // namespace
