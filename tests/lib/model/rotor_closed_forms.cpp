// Gyroscopic, circulatory and other unsymmetric matrices next to closed forms of Jeffcott's and of Stodola's
// and Green's rotors.
#include "catch.hpp"

#include "lib/model/rotors.hpp"

#include <arcslip/analyses/responses/parameter_response.hpp>
#include <arcslip/observables/unresolved_resonances.hpp>

#include <algorithm>
#include <cmath>

using namespace arcslip;
using namespace rotors;

namespace {

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
  const auto with = [&](const std::string& rotation) {
    return read(scene_of(R"(, "damping": "C.mtx", "circulatory": "N.mtx")",
                         R"(, "rotation": {"name": "rotor", )" + rotation + "}", along_x),
                folder);
  };
  const scene::Scene s = with(R"("speed": 1)");
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
  // The same where the rotor turns with the excitation.
  const auto response =
      observables::frequency_response(with(R"("engine_order": 1)"), {0.5 * onset, 2 * onset, true}).at(0);
  REQUIRE(response.points.size() > 5);
  for (const auto& point : response.points) {
    REQUIRE(point.stability);
    CHECK(point.stability->unstable == (point.omega < onset ? 0 : 2));
  }
  REQUIRE(std::count_if(response.events.begin(), response.events.end(),
                        [](const auto& event) { return event.kind == "neimark_sacker"; }) == 1);
  for (const auto& event : response.events)
    if (event.kind == "neimark_sacker") CHECK(event.point.omega == Approx(onset).epsilon(1e-8));
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
