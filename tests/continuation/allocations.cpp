#include "catalogue.hpp"
#include "catch.hpp"
#include "environment.hpp"

#include "continuation/events/hopf_problems.hpp"
#include "lib/laws/coupled_spring.hpp"

#include <arcslip/continuation/correction/corrector.hpp>
#include <arcslip/continuation/special_points/hopf_curve.hpp>
#include <arcslip/continuation/special_points/stationary.hpp>
#include <arcslip/hbm/problem.hpp>
#include <arcslip/laws/hysteresis/bouc_wen.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/memoryless/quadratic_damper.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/model/model.hpp>
#include <arcslip/time/newmark/newmark.hpp>

#include <cstdlib>
#include <new>

namespace {

volatile std::size_t calls = 0;

}  // namespace

extern "C" {
void* __real_malloc(std::size_t size);
void* __wrap_malloc(std::size_t size) {
  calls = calls + 1;
  return __real_malloc(size);
}
}

// Not inlined: GCC takes the one without the other for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

using namespace arcslip;

TEST_CASE("malloc is counted here") {
  const std::size_t before = calls;
  int* volatile kept = new int(1);
  delete kept;
  Eigen::VectorXd v(1000);
  const std::size_t counted = calls - before;
  CHECK(counted == 2);
  CHECK(v.size() == 1000);
}

TEST_CASE("a Newton iteration allocates nothing, up to 300 unknowns") {
  for (const char* friction : {"exact", "sampled"})
    for (int order : {1, 7, 55, 151, 299}) {
      scene::Scene scene =
          scene::read_file(source_folder() + "/examples/al_sayed_2011/scene.json", test_catalogue::whole());
      scene.harmonics.order = order;
      scene.harmonics.samples = 2 * (2 * order + 2);
      if (std::string(friction) == "sampled") scene.harmonics.friction = scene::Friction::sampled;
      const auto model = std::make_shared<const model::Model>(model::build(scene));
      const auto problem = std::make_shared<const hbm::HbmProblem>(model, model->harmonics, 1e-3, 25.0);
      const continuation::Vector p = hbm::parameters_at(*problem, 125.5);
      const auto u = hbm::steady_state(problem, p).u;
      REQUIRE(u);
      continuation::Counts counts;
      continuation::Corrector corrector(*problem, p, model::frequency, {}, counts);
      continuation::Vector v(problem->size() + 1), row = continuation::Vector::Zero(v.size()), t(v.size());
      row[row.size() - 1] = 1;
      v << 1.02 * *u, 125.5;
      const continuation::Vector far = v;
      corrector.correct(v, row, false);  // first-time growth of buffers, if any
      v = far;
      const std::size_t before = calls;
      const auto correction = corrector.correct(v, row, false);
      corrector.tangent(t);
      const std::size_t during = calls - before;
      CAPTURE(friction, order, correction.iterations);
      CHECK(correction.converged);
      CHECK(correction.iterations >= 1);
      CHECK(during == 0);
    }
}

TEST_CASE("a step of Newmark's method allocates nothing, up to 60 degrees of freedom") {
  for (const int n : {1, 2, 7, 60}) {
    time::EquationOfMotion equation;
    equation.omega = 1.1;
    equation.M = equation.C = equation.K = Eigen::MatrixXd::Identity(n, n);
    equation.C *= 0.05;
    equation.M(n - 1, n - 1) = n > 1 ? 0 : 1;  // massless
    equation.response = Eigen::VectorXd::Unit(n, 0);
    equation.forces.push_back({Eigen::VectorXd::Ones(n), 1, 1.0, 0.5});
    for (int i = 0; i < n; ++i)
      equation.add("d", elements::jenkins().law({}), {0.5, 1, 0.1}, Eigen::VectorXd::Unit(n, i));
    equation.add("c", elements::cubic_spring().law({}), {0.1}, Eigen::VectorXd::Unit(n, 0));
    equation.add("h", elements::bouc_wen().law({}), {0.5, 0.1, 0.2, 1.5, 0.7}, Eigen::VectorXd::Unit(n, 0));
    equation.add("q", elements::quadratic_damper().law({}), {0.3}, Eigen::VectorXd::Unit(n, n - 1));
    const own_laws::CoupledSpring coupled;
    if (n > 1) equation.add("p", coupled.law({}), {0.2}, Eigen::MatrixXd::Identity(n, 2));
    time::Newmark newmark(equation, 40);
    REQUIRE(newmark.begin(time::at_rest(equation)) == time::Solved::yes);
    REQUIRE(newmark.step() == time::Solved::yes);
    const std::size_t before = calls;
    bool solved = true;
    for (int k = 0; k < 400; ++k) solved = solved && newmark.step() == time::Solved::yes;
    const std::size_t counted = calls - before;
    CHECK(solved);
    CHECK(counted == 0);
  }
}

TEST_CASE("an element allocates nothing, smooth hysteresis and laws of velocity included") {
  const elements::Harmonics h{21};
  const struct {
    const elements::PlainLaw& law;
    std::vector<double> fields;
  } all[] = {{elements::bouc_wen(), {0.5, 0.1, 0.2, 1.5, 0.7}},
             {elements::quadratic_damper(), {0.3}},
             {elements::van_der_pol(), {0.1, 0.4}}};
  for (const auto& each : all) {
    const auto element = each.law.element(h, {});
    const Eigen::VectorXd u = Eigen::VectorXd::Random((1 + each.law.auxiliary()) * h.size());
    element->set_frequency(1.1);
    element->move_to(u, each.fields, true);
    const std::size_t before = calls;
    for (int k = 0; k < 10; ++k) element->move_to(u, each.fields, true);
    const std::size_t counted = calls - before;
    CAPTURE(each.law.name());
    CHECK(counted == 0);
  }
}

TEST_CASE("nor does one on a curve of folds, or of Hopf points, of a problem that allocates nothing") {
  using namespace problems;
  const auto inner = [](bool second) {
    Functions f;
    f.size = 2;
    f.parameters = {parameter("mu", 0), parameter("lambda", 1)};
    f.residual = [](In u, In p, Out F) {
      F[0] = p[0] + p[1] * u[0] - u[0] * u[0] * u[0] + u[1];
      F[1] = -2 * u[0] - u[1];
    };
    f.jacobian = [](In u, In p, Eigen::Ref<Matrix> J) { J << p[1] - 3 * u[0] * u[0], 1, -2, -1; };
    f.derivative = [](In u, In, int k, Out dF) {
      dF[0] = k == 0 ? 1 : u[0];
      dF[1] = 0;
    };
    if (second)
      f.second = [](In u, In, In w, In v, In q, Out du, Out dp) {
        du << w[0] * (-6 * u[0] * v[0] + q[1]), 0;
        dp << 0, w[0] * v[0];
      };
    return from_functions(f);
  };
  const auto check = [](const std::shared_ptr<const Problem>& problem, const Vector& x, const Vector& p) {
    Counts counts;
    Corrector corrector(*problem, p, 1, {}, counts);
    Vector v(x.size() + 1), row = Vector::Unit(x.size() + 1, x.size()), t(x.size() + 1);
    v << x, p[1];
    const Vector guess = v;
    corrector.correct(v, row, false);
    v = guess;
    const std::size_t before = calls;
    const auto correction = corrector.correct(v, row, false);
    corrector.tangent(t);
    const std::size_t during = calls - before;
    CHECK(correction.converged);
    CHECK(correction.iterations >= 1);
    CHECK(during == 0);
  };
  for (const bool second : {false, true}) {
    // J = [a, 1; -2, -1], a = lambda - 3 x^2: a fold at a = 2, a Hopf point with omega = 1 at a = 1; y = -2
    // x.
    CAPTURE(second);
    check(folds(inner(second), 0), Vector{{1.02, -2.04, -2.0}}, Vector{{0.0, 5.0}});
    check(hopf_points(inner(second), 0, 1), Vector{{1.02, -2.04, -1.0, 1.1}}, Vector{{0.0, 4.0}});
  }
}
