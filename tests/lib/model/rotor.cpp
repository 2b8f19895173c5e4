// A rotor with every kind of matrix next to dense solutions of the whole equation, and motions in time.
#include "catch.hpp"
#include "contains.hpp"

#include "lib/model/rotors.hpp"

#include <arcslip/analyses/modes_and_time/nonlinear_modes.hpp>
#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/hbm/linear/dynamic_stiffness.hpp>
#include <arcslip/results/reasons.hpp>
#include <arcslip/time/periodic/shooting_problem.hpp>

#include <cmath>

using namespace arcslip;
using namespace rotors;
using continuation::Vector;

namespace {

// A rotor of eight rows with all of the matrices.
struct Everything {
  Eigen::MatrixXd M, K, C, K2, G, N;
  std::string keys =
      R"(, "damping": "C.mtx", "stiffness_speed_squared": "K2.mtx", "gyroscopic": "G.mtx", "circulatory": "N.mtx",
         "unsymmetric": ["stiffness", "damping"])";

  Everything() {
    std::srand(7);
    const int n = 8;
    const auto random = [&] { return Eigen::MatrixXd(Eigen::MatrixXd::Random(n, n)); };
    const auto definite = [&](double diagonal, double nearby) {
      const Eigen::MatrixXd R = random();
      Eigen::MatrixXd A = nearby * (R + R.transpose());
      for (int i = 0; i < n; ++i) A(i, i) = diagonal * (1 + 0.1 * i);
      return A;
    };
    const auto skew = [&](double size) {
      const Eigen::MatrixXd R = random();
      return Eigen::MatrixXd(size * (R - R.transpose()));
    };
    M = definite(1, 0.03);
    K = definite(100, 4) + skew(0.4);
    C = definite(0.5, 0.02) + skew(0.03);
    K2 = definite(1, 0.1);
    G = skew(0.2);
    N = skew(0.08);
  }
  Folder files() const {
    return {{"M.mtx", matrix_market(M)},
            {"K.mtx", matrix_market(K)},
            {"C.mtx", matrix_market(C)},
            {"K2.mtx", matrix_market(K2)},
            {"G.mtx", matrix_market(G)},
            {"N.mtx", matrix_market(N)},
            {"names.csv", "name,row\nx,3\ny,2\nb,6\n"}};
  }
  Eigen::MatrixXcd dynamic_stiffness(double s, double speed) const {
    return (K + speed * N + speed * speed * K2 - s * s * M).cast<Complex>() +
           Complex(0, s) * (C + speed * G).cast<Complex>();
  }
};

const std::string turning = R"(, "rotation": {"name": "rotor", "speed": 3.5})";
const std::string sticking =
    R"({"name": "d", "type": "jenkins", "at": "b", "stiffness": 30, "friction_coefficient": 0.5,
        "normal_load": 1e6})";
const std::string rubbing =
    R"({"name": "d", "type": "jenkins", "at": "b", "stiffness": 30, "friction_coefficient": 0.5,
        "normal_load": 0.02})";

}  // namespace

TEST_CASE("with every matrix a rotor answers as the full complex system does") {
  const Everything rotor;
  const Folder folder = rotor.files();
  const scene::Scene s = read(scene_of(rotor.keys, turning, forward, sticking), folder);
  CHECK(read(scene::write(s), folder) == s);
  for (const double omega : {1.0, 8.0, 10.4, 13.0, 40.0}) {
    CAPTURE(omega);
    Eigen::MatrixXcd Z = rotor.dynamic_stiffness(omega, 3.5);
    Z(5, 5) += 30;
    Eigen::VectorXcd f = Eigen::VectorXcd::Zero(8);
    f[2] = 1.5;
    f[1] = Complex(0, -1.5);
    const Eigen::VectorXcd X = continuation::solve_complex(Z, f);
    const auto point = scenes::response_at(s, omega);
    CHECK(point.amplitude == Approx(std::abs(X[2])).epsilon(1e-12));
    CHECK(point.elements.at(0).energy == 0);
    CHECK(point.energy_viscous == Approx(std::numbers::pi * X.dot(Z * X).imag()).epsilon(1e-11));
    CHECK(point.forces.inertia + point.forces.spring + 30 * std::norm(X[5] / X[2]) ==
          Approx(X.dot(Z * X).real() / std::norm(X[2])).epsilon(1e-11));
  }
}

TEST_CASE(
    "equations of rotors have the derivatives of differences, with the speed and with an engine order") {
  const Everything rotor;
  const Folder folder = rotor.files();
  for (const std::string& rotation :
       {turning, std::string(R"(, "rotation": {"name": "rotor", "engine_order": 2})")}) {
    CAPTURE(rotation);
    const scene::Scene s =
        read(scene_of(rotor.keys, rotation + R"(, "damping": [{"name": "steel", "type": "rayleigh",
                         "alpha": 0.1, "beta": 1e-3}, {"name": "loss", "type": "loss_factor", "loss_factor": 0.02}])",
                      forward, rubbing, 3),
             folder);
    const auto model = std::make_shared<const model::Model>(model::build(s));
    const hbm::HbmProblem problem(model, model->harmonics, 1e-3, 9);
    std::srand(3);
    for (int k = 0; k < 4; ++k) {
      const Vector u = 1e-3 * Vector::Random(problem.size());
      CHECK(continuation::check_jacobian(problem, u, hbm::parameters_at(problem, 9)).message == "");
    }
    // Of the response, too, which is no unknown.
    hbm::DynamicStiffness Z(*model, problem.coordinates(), model->harmonics);
    Vector p = model::defaults(*model);
    p[model::frequency] = 9;
    const Eigen::Index c = model->harmonics.size();
    const Vector u = Vector::Random(Z.places() > 0 ? problem.coordinates().unknowns * c : 0),
                 a = Vector::Random(c);
    Vector dx(c), plus(c), minus(c), x(c), zero(c), g(u.size());
    for (const char* name : {"frequency", "steel.beta", "rotor.speed"}) {
      if (name == std::string("rotor.speed") && rotation != turning) continue;
      const int k = model::parameter_index(*model, name);
      REQUIRE(Z.move_to(p));
      Z.response_derivative(k, u, 1, dx);
      const double step = 1e-5 * p[k];
      Vector q = p;
      q[k] += step;
      REQUIRE(Z.move_to(q));
      Z.response(u, 1, plus);
      q[k] -= 2 * step;
      REQUIRE(Z.move_to(q));
      Z.response(u, 1, minus);
      CHECK((dx - (plus - minus) / (2 * step)).norm() < 1e-7 * dx.norm());
    }
    REQUIRE(Z.move_to(p));
    Z.response(u, 0, x);
    Z.response_transposed(a, g);
    CHECK(g.dot(u) == Approx(a.dot(x)).epsilon(1e-12));
  }
}

TEST_CASE(
    "equations of shooting of rotors have the derivatives of differences, with an engine order as well") {
  const Everything rotor;
  for (const std::string& rotation :
       {turning, std::string(R"(, "rotation": {"name": "rotor", "engine_order": 2})")}) {
    CAPTURE(rotation);
    const scene::Scene s =
        read(scene_of(rotor.keys, rotation + R"(, "damping": [{"name": "steel", "type": "rayleigh",
                         "alpha": 0.1, "beta": 1e-3}])",
                      forward, rubbing),
             rotor.files());
    const auto model = std::make_shared<const model::Model>(model::build(s));
    const time::ShootingProblem problem(model, 1e-3, 9, 9);
    Vector p = model::defaults(*model);
    p[model::frequency] = 9;
    std::srand(3);
    for (int k = 0; k < 4; ++k) {
      const Vector X = problem.scales().cwiseProduct(Vector::Random(problem.size()));
      CHECK(continuation::check_jacobian(problem, X, p).message == "");
    }
  }
}

TEST_CASE("a branch over the speed is that of responses at its speeds, whole and reduced") {
  const Everything rotor;
  const Folder folder = rotor.files();
  const std::string of_reduced = R"(, "highest_frequency": 60)";
  const std::string fast = R"(, "rotation": {"name": "rotor", "speed": 3.5, "highest_speed": 10})";
  const scene::Scene whole = read(scene_of(rotor.keys, turning, forward, rubbing, 3), folder),
                     reduced = read(scene_of(rotor.keys + of_reduced, fast, forward, rubbing, 3), folder);
  for (const double omega : {4.0, 9.0, 10.4})
    CHECK(scenes::response_at(reduced, omega).amplitude ==
          Approx(scenes::response_at(whole, omega).amplitude).epsilon(1e-9));
  const auto branch =
      observables::parameter_response(reduced, {.over = "rotor.speed", .from = 1, .to = 9, .frequency = 9.5})
          .at(0);
  REQUIRE(branch.points.size() > 4);
  for (std::size_t k = 0; k < branch.points.size(); k += 3) {
    scene::Scene s = whole;
    scene::set(s, "rotor.speed", branch.points[k].over);
    CHECK(branch.points[k].amplitude == Approx(scenes::response_at(s, 9.5).amplitude).epsilon(1e-8));
  }
}

TEST_CASE("motions of rotors in time are those of harmonic balance, and their energies balance") {
  const Everything rotor;
  const Folder folder = rotor.files();
  const scene::Scene stuck = read(scene_of(rotor.keys, turning, forward, sticking), folder);
  const double amplitude = scenes::response_at(stuck, 9).amplitude;
  using observables::TimeMethod;
  for (const auto method : {TimeMethod::shooting, TimeMethod::newmark_shooting, TimeMethod::event_driven}) {
    CAPTURE(static_cast<int>(method));
    const auto motion = observables::motion_in_time(stuck, {.frequency = 9, .method = method, .steps = 2000});
    REQUIRE(motion.status == observables::Status::complete);
    CHECK(motion.amplitude ==
          Approx(amplitude).epsilon(method == TimeMethod::newmark_shooting ? 1e-5 : 1e-8));
    CHECK(std::abs(motion.energy.defect()) < 1e-9 * motion.energy.input);
  }
  // With slip: the harmonics converge to the motion.
  scene::Scene s = read(scene_of(rotor.keys, turning, forward, rubbing, 41), folder);
  const auto motion = observables::motion_in_time(s, {.frequency = 9});
  REQUIRE(motion.status == observables::Status::complete);
  observables::FrequencyRange range{9, 9.001, true};
  const auto branch = observables::frequency_response(s, range).at(0);
  const auto& point = branch.points.front();
  CHECK(point.elements.at(0).energy > 0);
  CHECK(point.amplitude == Approx(motion.amplitude).epsilon(1e-6));
  REQUIRE(point.stability);
  CHECK(std::abs(point.stability->multipliers.at(0) - motion.multipliers.at(0)) < 1e-4);
}

TEST_CASE("modal damping of a rotor is of the modes at rest") {
  const Everything rotor;
  const Folder folder = rotor.files();
  const std::string modal = R"(, "damping": [{"name": "zeta", "type": "modal", "ratio": 0.02}])";
  const scene::Scene s = read(scene_of(rotor.keys, turning + modal, forward), folder);
  const auto modes = continuation::symmetric_modes(0.5 * (rotor.K + rotor.K.transpose()), rotor.M);
  const Eigen::MatrixXd MV = rotor.M * modes.V;
  const Eigen::MatrixXd damping = MV * (0.04 * modes.values.cwiseSqrt()).asDiagonal() * MV.transpose();
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(8);
  f[2] = 1.5;
  f[1] = Complex(0, -1.5);
  const Eigen::MatrixXcd Z = rotor.dynamic_stiffness(10, 3.5) + Complex(0, 10) * damping.cast<Complex>();
  CHECK(scenes::response_at(s, 10).amplitude ==
        Approx(std::abs(continuation::solve_complex(Z, f)(2, 0))).epsilon(1e-11));
}

TEST_CASE("modes of rotors are refused") {
  const Everything rotor;
  const scene::Scene s = read(scene_of(rotor.keys, turning, forward, rubbing), rotor.files());
  const auto branches = observables::nonlinear_modes(s, {.mode = 1, .from = 1e-4, .to = 1e-3});
  REQUIRE(branches.size() == 1);
  CHECK(branches[0].stop.reason == observables::reasons::no_mode);
  CHECK(
      contains(branches[0].stop.message, "modes of gyroscopic, circulatory and other unsymmetric matrices"));
}
