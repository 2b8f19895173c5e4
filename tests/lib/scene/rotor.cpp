// Rotors: gyroscopic, circulatory and other unsymmetric matrices from files, beside closed forms of
// Jeffcott's and of Stodola's and Green's rotors, dense solutions of the whole equation, and motions in time.
#include "catch.hpp"
#include "contains.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/scene/folder.hpp"

#include <arcslip/continuation/problem/jacobian_check.hpp>
#include <arcslip/hbm/dynamic_stiffness.hpp>
#include <arcslip/observables/curves.hpp>
#include <arcslip/observables/nonlinear_modes.hpp>
#include <arcslip/observables/reasons.hpp>
#include <arcslip/observables/time_study.hpp>
#include <arcslip/observables/truncation.hpp>
#include <arcslip/scene/json_schema.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iomanip>
#include <sstream>

using namespace arcslip;
using continuation::Vector;
using Complex = std::complex<double>;

namespace {

std::string matrix_market(const Eigen::MatrixXd& A) {
  std::ostringstream text;
  text << std::setprecision(17) << "%%MatrixMarket matrix array real general\n"
       << A.rows() << ' ' << A.cols() << '\n';
  for (const double value : A.reshaped()) text << value << '\n';
  return text.str();
}

// The matrix of a complex factor of x + i y, a block for each factor: c z is (c_r x - c_i y, c_i x + c_r y).
Eigen::MatrixXd planes(const Eigen::MatrixXcd& factors) {
  Eigen::MatrixXd A(2 * factors.rows(), 2 * factors.cols());
  for (Eigen::Index j = 0; j < factors.cols(); ++j)
    for (Eigen::Index i = 0; i < factors.rows(); ++i) {
      const Complex c = factors(i, j);
      A.block(2 * i, 2 * j, 2, 2) << c.real(), -c.imag(), c.imag(), c.real();
    }
  return A;
}

// Without parts beyond the matrices. keys: of "matrices"; more: beside them.
std::string scene_of(const std::string& keys, const std::string& more, const std::string& force,
                     const std::string& elements = "", int order = 1) {
  return R"({"format": "arcslip-scene-1", "frequency_unit": "rad/s", "structure": {"matrices":
      {"mass": "M.mtx", "stiffness": "K.mtx")" +
         keys + R"(}, "names": "names.csv")" + more + R"(}, "elements": [)" + elements +
         R"(], "excitation": [)" + force + R"(], "response": {"at": "x"}, "harmonics": {"order": )" +
         std::to_string(order) + R"(}, "studies": [{"kind": "frf", "from": 2, "to": 20}]})";
}

scene::Scene read(const std::string& whole, const Folder& folder) {
  std::istringstream in(whole);
  return scene::read(in, test_catalogue::whole(), folder.path());
}

std::string fault(const std::string& whole, const Folder& folder) {
  try {
    read(whole, folder);
  } catch (const scene::SceneError& error) {
    return error.what();
  }
  return "none";
}

const std::string along_x = R"({"name": "f", "at": "x", "cosine": 1.5})";
// Turns with x + i y, or against it.
const std::string forward = along_x + R"(, {"name": "g", "at": "y", "sine": 1.5})";
const std::string backward = along_x + R"(, {"name": "g", "at": "y", "sine": -1.5})";

// A disk of the moments of inertia across and along the shaft on a support that holds its inclination.
struct Inclined {
  double across = 0.4, along = 0.7, stiffness = 90, damping = 0.02, speed = 11;

  Complex response(double omega) const {
    return 1.0 / Complex(stiffness - across * omega * omega + along * speed * omega, damping * omega);
  }
  Folder files() const {
    const Eigen::MatrixXcd one = Eigen::MatrixXcd::Ones(1, 1);
    return {{"M.mtx", matrix_market(planes(across * one))},
            {"K.mtx", matrix_market(planes(stiffness * one))},
            {"C.mtx", matrix_market(planes(damping * one))},
            {"G.mtx", matrix_market(planes(Complex(0, -along) * one))},
            {"names.csv", "name,row\nx,1\ny,2\n"}};
  }
  std::string keys() const { return R"(, "damping": "C.mtx", "gyroscopic": "G.mtx")"; }
  std::string rotation() const {
    return R"(, "rotation": {"name": "rotor", "speed": )" + std::to_string(speed) + "}";
  }
};

}  // namespace

// across p'' - i along speed p' + damping p' + stiffness p = force
TEST_CASE("an inclined disk answers forward, backward and standing forces as its closed form says") {
  const Inclined disk;
  const Folder folder = disk.files();
  for (const double omega : {0.5, 7.0, 14.9, 21.0, 60.0}) {
    CAPTURE(omega);
    const auto amplitude = [&](const std::string& force) {
      return scenes::response_at(read(scene_of(disk.keys(), disk.rotation(), force), folder), omega)
          .amplitude;
    };
    const Complex with = disk.response(omega), against = disk.response(-omega);
    CHECK(amplitude(forward) == Approx(1.5 * std::abs(with)).epsilon(1e-12));
    CHECK(amplitude(backward) == Approx(1.5 * std::abs(against)).epsilon(1e-12));
    CHECK(amplitude(along_x) == Approx(0.75 * std::abs(with + std::conj(against))).epsilon(1e-12));
  }
}

TEST_CASE("the peaks of an inclined disk are its backward and forward whirl") {
  Inclined disk;
  disk.damping = 1e-5;
  const Folder folder = disk.files();
  const double half = 0.5 * disk.along * disk.speed / disk.across,
               root = std::sqrt(half * half + disk.stiffness / disk.across);
  const scene::Scene s = read(scene_of(disk.keys(), disk.rotation(), along_x), folder);
  const auto branches = observables::frequency_response(s, {1, 60});
  std::vector<double> peaks;
  for (const auto& event : branches.at(0).events)
    if (event.kind == "peak") peaks.push_back(event.point.omega);
  REQUIRE(peaks.size() == 2);
  CHECK(peaks[0] == Approx(root - half).epsilon(1e-8));
  CHECK(peaks[1] == Approx(root + half).epsilon(1e-8));
  // The highest of them is what the harmonics have to reach.
  const model::Model model = model::build(s);
  CHECK(observables::highest_natural_frequency(model, model::defaults(model)) ==
        Approx(root + half).epsilon(1e-12));
}

// A disk at the end of a shaft without mass, clamped at the other: A. Stodola, Steam and gas turbines (1927);
// R. Green, J. Appl. Mech. 15 (1948) 369. Z and Phi: deflection and inclination, as complex numbers:
//
//   (k11 - m w^2) Z + k12 Phi = m e W^2,   k12 Z + (k22 - I_d w^2 + I_p W w) Phi = 0
TEST_CASE("the unbalance response of Stodola's and Green's rotor at its own speed") {
  const double m = 12, across = 0.3, along = 0.55, EI = 8e4, length = 0.6, eccentricity = 1e-5;
  const double k11 = 12 * EI / std::pow(length, 3), k12 = -6 * EI / std::pow(length, 2),
               k22 = 4 * EI / length;
  Eigen::MatrixXcd M(2, 2), K(2, 2), G = Eigen::MatrixXcd::Zero(2, 2);
  M << m, 0, 0, across;
  K << k11, k12, k12, k22;
  G(1, 1) = Complex(0, -along);
  const Folder folder{{"M.mtx", matrix_market(planes(M))},
                      {"K.mtx", matrix_market(planes(K))},
                      {"G.mtx", matrix_market(planes(G))},
                      {"r.mtx", "%%MatrixMarket matrix array real general\n4 2\n1\n0\n0\n0\n0\n-1\n0\n0\n"},
                      {"names.csv", "name,row\nx,1\ny,2\n"}};
  // A displacement of the ground by e that turns has the forces m e W^2 of an unbalance.
  const std::string unbalance = R"({"name": "u", "type": "base_displacement", "cosine": 1e-5,
      "shape": {"file": "r.mtx", "column": 1}, "imaginary_shape": {"file": "r.mtx", "column": 2}})";
  const scene::Scene s = read(scene_of(R"(, "gyroscopic": "G.mtx")",
                                       R"(, "rotation": {"name": "rotor", "engine_order": 1})", unbalance),
                              folder);
  for (const double speed : {50.0, 240.0, 700.0, 2000.0}) {
    CAPTURE(speed);
    const double square = speed * speed, a = k11 - m * square, d = k22 - across * square + along * square;
    const double deflection = m * eccentricity * square * d / (a * d - k12 * k12);
    CHECK(scenes::response_at(s, speed).amplitude == Approx(std::abs(deflection)).epsilon(1e-11));
  }
  // With I_p > I_d the forward whirl has one critical speed only: a d = k12^2.
  const double b = across - along;
  const double p = k11 * b + k22 * m, q = k11 * k22 - k12 * k12;
  const double critical = std::sqrt((p - std::sqrt(p * p - 4 * m * b * q)) / (2 * m * b));
  CHECK(scenes::response_at(s, 0.9999 * critical).amplitude > 1e3 * eccentricity);
  CHECK(scenes::response_at(s, 1.0001 * critical).amplitude > 1e3 * eccentricity);
}

namespace {

// Jeffcott's rotor: m z'' + c z' + (k - i q) z = f, q the cross-coupling of a bearing or a seal.
struct Jeffcott {
  double m = 2, c = 0.8, k = 50, q = 3;

  double force(double omega) const { return std::abs(Complex(k - m * omega * omega, c * omega - q)); }
  Folder files() const {
    const Eigen::MatrixXcd one = Eigen::MatrixXcd::Ones(1, 1);
    return {{"M.mtx", matrix_market(planes(m * one))},
            {"K.mtx", matrix_market(planes(Complex(k, -q) * one))},
            {"C.mtx", matrix_market(planes(c * one))},
            {"k.mtx", matrix_market(planes(k * one))},
            {"N.mtx", matrix_market(planes(Complex(0, -q) * one))},
            {"names.csv", "name,row\nx,1\ny,2\n"}};
  }
};
const std::string cross_coupled = R"(, "damping": "C.mtx", "unsymmetric": ["stiffness"])";

}  // namespace

TEST_CASE("a cross-coupled stiffness damps backward whirl and feeds forward whirl") {
  const Jeffcott rotor;
  const Folder folder = rotor.files();
  const auto [keys, stiffness] = GENERATE(table<std::string, std::string>(
      {{cross_coupled, "K.mtx"}, {R"(, "damping": "C.mtx", "circulatory": "N.mtx")", "k.mtx"}}));
  for (const double omega : {0.7, 4.0, 5.1, 9.0}) {
    CAPTURE(omega, keys);
    for (const double direction : {1.0, -1.0}) {
      std::string text = scene_of(keys, "", direction > 0 ? forward : backward);
      text.replace(text.find("K.mtx"), 5, stiffness);
      const auto point = scenes::response_at(read(text, folder), omega);
      const double amplitude = 1.5 / rotor.force(direction * omega);
      CHECK(point.amplitude == Approx(amplitude).epsilon(1e-12));
      // Dampers and the cross-coupling take what the force gives; with q > c w it would be the other way.
      const double lost =
          2 * std::numbers::pi * (rotor.c * omega - direction * rotor.q) * amplitude * amplitude;
      CHECK(point.energy_viscous == Approx(lost).epsilon(1e-11));
      CHECK(point.energy_input == Approx(lost).epsilon(1e-11));
      const double square = amplitude * amplitude;
      CHECK(point.forces.inertia == Approx(-2 * rotor.m * omega * omega).epsilon(1e-11));
      CHECK(point.forces.spring == Approx(2 * rotor.k).epsilon(1e-11));
      CHECK(point.forces.viscous == Approx(lost / square / std::numbers::pi).epsilon(1e-11));
    }
  }
}

TEST_CASE("gyroscopic forces are among those of the inertia, and lose no energy") {
  const Inclined disk;
  const auto point =
      scenes::response_at(read(scene_of(disk.keys(), disk.rotation(), forward), disk.files()), 9.0);
  CHECK(point.forces.inertia == Approx(2 * (disk.along * disk.speed * 9 - disk.across * 81)).epsilon(1e-11));
  const double square = point.amplitude * point.amplitude;
  CHECK(point.energy_viscous == Approx(2 * std::numbers::pi * disk.damping * 9 * square).epsilon(1e-11));
}

TEST_CASE("rotors are unstable where their closed form is, and multipliers are its exponentials") {
  Jeffcott rotor;
  const double onset = rotor.c * std::sqrt(rotor.k / rotor.m);  // of q
  for (const double q : {0.5 * onset, 0.999 * onset, 1.001 * onset, 2 * onset}) {
    rotor.q = q;
    const Folder folder = rotor.files();
    const scene::Scene s = read(scene_of(cross_coupled, "", along_x), folder);
    for (const bool by_hill : {false, true}) {
      observables::FrequencyRange range{4, 4.001, true};
      range.stability.by_hill = by_hill;
      const auto branch = observables::frequency_response(s, range).at(0);
      const auto& stability = branch.points.front().stability;
      CAPTURE(q, onset, by_hill);
      REQUIRE(stability);
      CHECK(stability->unstable == (q < onset ? 0 : 2));
      REQUIRE(stability->multipliers.size() == 4);
      const double period = 2 * std::numbers::pi / branch.points.front().omega;
      const Complex root = std::sqrt(Complex(rotor.c * rotor.c - 4 * rotor.m * rotor.k, 4 * rotor.m * q));
      for (const double sign : {1.0, -1.0}) {
        const Complex exact = std::exp((-rotor.c + sign * root) / (2 * rotor.m) * period);
        for (const Complex& wanted : {exact, std::conj(exact)}) {
          double nearest = 1e9;
          for (const Complex& each : stability->multipliers)
            nearest = std::min(nearest, std::abs(each - wanted));
          CHECK(nearest < 1e-9 * std::abs(exact));
        }
      }
    }
  }
}

// Internal damping c_i turns with the rotor: circulatory forces c_i W, unstable above W = w_0 (1 + c_e/c_i).
TEST_CASE("a branch over the speed loses its stability where internal damping destabilizes the rotor") {
  const double m = 2, k = 50, outer = 0.6, inner = 0.5;
  const Eigen::MatrixXcd one = Eigen::MatrixXcd::Ones(1, 1);
  const Folder folder{{"M.mtx", matrix_market(planes(m * one))},
                      {"K.mtx", matrix_market(planes(k * one))},
                      {"C.mtx", matrix_market(planes((outer + inner) * one))},
                      {"N.mtx", matrix_market(planes(Complex(0, -inner) * one))},
                      {"names.csv", "name,row\nx,1\ny,2\n"}};
  const scene::Scene s = read(scene_of(R"(, "damping": "C.mtx", "circulatory": "N.mtx")",
                                       R"(, "rotation": {"name": "rotor", "speed": 1})", along_x),
                              folder);
  const double onset = std::sqrt(k / m) * (1 + outer / inner);
  observables::ParameterRange range{.over = "rotor.speed", .from = 1, .to = 2 * onset, .frequency = 3};
  range.stability = true;
  const auto branch = observables::parameter_response(s, range).at(0);
  REQUIRE(branch.points.size() > 5);
  for (const auto& point : branch.points) {
    REQUIRE(point.stability);
    CHECK(point.stability->unstable == (point.over < onset ? 0 : 2));
  }
  int found = 0;
  for (const auto& event : branch.events)
    if (event.kind == "neimark_sacker") {
      ++found;
      CHECK(event.point.over == Approx(onset).epsilon(1e-8));
    }
  CHECK(found == 1);
}

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
    const auto definite = [&](double diagonal, double beside) {
      const Eigen::MatrixXd R = random();
      Eigen::MatrixXd A = beside * (R + R.transpose());
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
    const Eigen::VectorXcd X = Z.partialPivLu().solve(f);
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
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
      Eigen::MatrixXd(0.5 * (rotor.K + rotor.K.transpose())), rotor.M);
  const Eigen::MatrixXd MV = rotor.M * modes.eigenvectors();
  const Eigen::MatrixXd damping = MV * (0.04 * modes.eigenvalues().cwiseSqrt()).asDiagonal() * MV.transpose();
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(8);
  f[2] = 1.5;
  f[1] = Complex(0, -1.5);
  const Eigen::MatrixXcd Z = rotor.dynamic_stiffness(10, 3.5) + Complex(0, 10) * damping.cast<Complex>();
  CHECK(scenes::response_at(s, 10).amplitude ==
        Approx(std::abs(Z.partialPivLu().solve(f)[2])).epsilon(1e-11));
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

TEST_CASE("a rotor that only circulatory forces hold does not drift") {
  const Eigen::MatrixXcd one = Eigen::MatrixXcd::Ones(1, 1);
  Eigen::MatrixXcd M = Eigen::MatrixXcd::Identity(2, 2), K(2, 2), N = Eigen::MatrixXcd::Zero(2, 2);
  K << 50, -50, -50, 50;
  N(1, 1) = Complex(0, -3);
  const Folder folder{{"M.mtx", matrix_market(planes(M))},
                      {"K.mtx", matrix_market(planes(K))},
                      {"N.mtx", matrix_market(planes(N))},
                      {"names.csv", "name,row\nx,1\ny,2\n"}};
  const std::string mean = along_x + R"(, {"name": "mean", "at": "x", "cosine": 0.5, "harmonic": 0})";
  const model::Model held = model::build(read(scene_of(R"(, "circulatory": "N.mtx")", "", mean), folder)),
                     free = model::build(read(scene_of("", "", mean), folder));
  CHECK_FALSE(model::drifting_dof(held, model::defaults(held)));
  CHECK(model::drifting_dof(free, model::defaults(free)));
}

TEST_CASE("what is wrong with unsymmetric matrices is told with the entry at fault") {
  const std::string head = "%%MatrixMarket matrix coordinate real ";
  const auto files = [&] {
    const std::string diagonal = head + "general\n3 3 3\n1 1 1\n2 2 2\n3 3 3\n";
    return Folder{{"M.mtx", diagonal},
                  {"K.mtx", diagonal},
                  {"C.mtx", diagonal},
                  {"G.mtx", head + "skew-symmetric\n3 3 1\n2 1 0.5\n"},
                  {"names.csv", "name,row\nx,1\n"}};
  };
  const auto with = [&](const std::string& keys, const std::string& name, const std::string& text,
                        const std::string& more = "") {
    const Folder folder = files();
    if (!name.empty()) folder.write(name, text);
    return fault(scene_of(keys, more, along_x), folder);
  };
  const std::string gyroscopic = R"(, "gyroscopic": "G.mtx")";
  CHECK(with(gyroscopic, "", "") == "none");
  CHECK(with(gyroscopic, "", "", R"(, "rotation": {"name": "rotor", "speed": 3})") == "none");
  CHECK(
      contains(with(gyroscopic, "G.mtx", head + "symmetric\n3 3 1\n2 1 0.5\n"),
               "/structure/matrices/gyroscopic: found the gyroscopic matrix with 0.5 in row 2, column 1 and "
               "0.5 in row 1, column 2, must be skew-symmetric: entries across the diagonal of opposite "
               "signs, and 0 on it"));
  CHECK(contains(with(gyroscopic, "G.mtx", head + "general\n3 3 1\n1 2 0.5\n"),
                 "with 0.5 in row 1, column 2 and 0 in row 2, column 1, must be skew-symmetric"));
  CHECK(contains(with(gyroscopic, "G.mtx", head + "general\n3 3 3\n1 2 0.5\n2 1 -0.5\n3 3 2\n"),
                 "with 2 in row 3, column 3, must be skew-symmetric"));
  CHECK(contains(
      with(gyroscopic, "G.mtx", head + "general\n2 2 0\n"),
      "/structure/matrices/gyroscopic: found a matrix of 2 rows, must have 3 as the stiffness matrix"));
  CHECK(contains(with(gyroscopic, "G.mtx", head + "general\n2 3 0\n"),
                 "found the gyroscopic matrix with 2 rows and 3 columns, must be square"));
  CHECK(contains(with(R"(, "circulatory": "G.mtx")", "G.mtx", head + "symmetric\n3 3 1\n2 1 0.5\n"),
                 "/structure/matrices/circulatory: found the circulatory matrix with 0.5 in row 2"));
  CHECK(contains(with(gyroscopic, "M.mtx", head + "general\n3 3 2\n1 1 1\n3 3 3\n"),
                 "/structure/matrices/gyroscopic: found the gyroscopic matrix with 0.5 in row 2, column 1, "
                 "where the mass matrix has 0 in row 2, column 2; -0.5 in row 1, column 2, where the mass "
                 "matrix has 0 in row 2, column 2, must have mass in both rows that it couples"));
  const std::string lopsided = head + "general\n3 3 4\n1 1 1\n2 2 2\n3 3 3\n1 2 0.5\n";
  CHECK(contains(with("", "K.mtx", lopsided),
                 "found the stiffness matrix with 0.5 in row 1, column 2 and 0 in row 2, column 1, must be "
                 "symmetric"));
  CHECK(with(R"(, "unsymmetric": ["stiffness"])", "K.mtx", lopsided) == "none");
  CHECK(contains(with(R"(, "damping": "C.mtx", "unsymmetric": ["stiffness"])", "C.mtx", lopsided),
                 "found the damping matrix with 0.5 in row 1, column 2"));
  CHECK(with(R"(, "damping": "C.mtx", "unsymmetric": ["damping"])", "C.mtx", lopsided) == "none");
  {
    const Folder folder = files();
    folder.write("C.mtx", lopsided);
    folder.write("M.mtx", head + "general\n3 3 2\n1 1 1\n3 3 3\n");
    CHECK(
        contains(fault(scene_of(R"(, "damping": "C.mtx", "unsymmetric": ["damping"])", "", along_x), folder),
                 "/structure/matrices/damping: found the damping matrix with 0.5 in row 1, column 2, where "
                 "the mass matrix has 0 in row 2, column 2"));
  }
  const std::string list = "must be a list of at least one of \"stiffness\", \"damping\"";
  CHECK(contains(with(R"(, "unsymmetric": true)", "", ""),
                 "/structure/matrices/unsymmetric: found true, " + list));
  CHECK(contains(with(R"(, "unsymmetric": [])", "", ""), "found an empty list, " + list));
  CHECK(contains(with(R"(, "unsymmetric": ["mass"])", "", ""),
                 "/structure/matrices/unsymmetric/0: found \"mass\", must be \"stiffness\" or \"damping\""));
  CHECK(contains(with(R"(, "unsymmetric": [1])", "", ""), "/structure/matrices/unsymmetric/0: found 1"));
  CHECK(contains(with(R"(, "unsymmetric": ["stiffness", "stiffness"])", "", ""),
                 "/structure/matrices/unsymmetric/1: found \"stiffness\" again, must be given once"));
  CHECK(contains(with(R"(, "unsymmetric": ["damping"])", "", ""),
                 "found \"damping\" without the key \"damping\", must be beside that matrix"));
  for (const char* key : {"\"gyroscopic\"", "\"circulatory\"", "\"unsymmetric\""})
    CHECK(contains(scene::json_schema(test_catalogue::whole()), key));
}
