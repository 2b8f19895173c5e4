// Floquet multipliers with friction in a plane: a closed form in slip, the same contact along a line, and
// next to Newmark's method with small steps.
#include "catch.hpp"

#include "lib/hbm/scenes.hpp"
#include "lib/laws/contact/contacts.hpp"
#include "lib/stability/along_harmonics.hpp"
#include "lib/stability/multiplier_distance.hpp"
#include "lib/time/equation/systems.hpp"
#include "lib/time/periodic/compared_with_exact.hpp"

#include <arcslip/analyses/modes_and_time/time_study.hpp>
#include <arcslip/continuation/linear/dense_algebra.hpp>
#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/contact/contact_3d.hpp>
#include <arcslip/stability/floquet.hpp>
#include <arcslip/stability/planar_slip_along.hpp>

#include <unsupported/Eigen/MatrixFunctions>

#include <cmath>
#include <numbers>

using namespace arcslip;
using multiplier_distance::distance, multiplier_distance::difference;
using namespace arcslip::time;
using std::numbers::pi;

namespace {

using Complex = std::complex<double>;

// The same mass in x and y and one along the normal, without couplings, and the contact.
EquationOfMotion pad(const elements::PlainLaw& law, std::vector<double> fields, const Matrix& directions,
                     double omega) {
  auto equation = systems::masses(Vector::Ones(directions.rows()));
  equation.omega = omega;
  equation.K.diagonal().setConstant(1);
  equation.C.diagonal().setConstant(0.07);
  equation.K(directions.rows() - 1, directions.rows() - 1) = 1.6;
  equation.add("pad", law.law({}), std::move(fields), directions);
  return equation;
}

std::vector<Complex> floquet_multipliers(const EquationOfMotion& equation,
                                         const elements::Harmonics& harmonics, const Matrix& q) {
  Floquet floquet(equation);
  REQUIRE(floquet.compute(equation.omega, harmonics, {{q, {}}}));
  return floquet.multipliers();
}

}  // namespace

TEST_CASE("slip along a circle has constant coefficients in a frame that turns with it: closed form") {
  const double omega = 1.3, k_t = 0.8, mu = 0.5, load = 1.2, h = mu * load / k_t;
  // Beyond 300 slip is relaxed, with an error of the order of the square of its time.
  const struct {
    double ratio, error;
  } cases[] = {{1.0001, 1e-9}, {1.7, 1e-9}, {9, 1e-9}, {200, 1e-9}, {400, 1e-7}, {1e4, 1e-8}, {1e7, 1e-8}};
  for (const auto& [ratio, error] : cases) {
    CAPTURE(ratio);
    const double a = ratio * h;
    const auto equation = pad(elements::contact_3d(), {k_t, 0, mu, load}, Matrix::Identity(3, 3), omega);
    const elements::Harmonics harmonics{1};
    Matrix q = Matrix::Zero(harmonics.size(), 3);
    q(harmonics.cosine_index(1), 0) = q(harmonics.sine_index(1), 1) = a;
    const auto found = floquet_multipliers(equation, harmonics, q);

    // x' = a (0, 1) and n = (cos phi, sin phi) there, h psi' = a cos phi with psi' = 1; (xi, xi', y).
    const double cosine = h / a, sine = std::sqrt((1 - cosine) * (1 + cosine)), g = a * sine / h;
    const Eigen::RowVector2d n(cosine, sine), t(-sine, cosine);
    const double c = 0.07 / omega, k = 1 / (omega * omega), of_t = k_t / (omega * omega);
    const Eigen::Matrix2d J{{0, -1}, {1, 0}}, I = Eigen::Matrix2d::Identity();
    Matrix A = Matrix::Zero(5, 5);
    A.block<2, 2>(0, 2) = I;
    A.block<2, 2>(2, 0) = (1 - k) * I - c * J - of_t * t.transpose() * t;
    A.block<2, 2>(2, 2) = -2 * J - c * I;
    A.block<2, 1>(2, 4) = -of_t * t.transpose();
    A.block<1, 2>(4, 0) = -g * t + n;
    A(4, 4) = -g;
    std::vector<Complex> exact;
    const Eigen::VectorXcd rates = continuation::eigenvalues(A);
    for (const Complex& rate : rates) exact.push_back(std::exp(2 * pi * rate));
    // Along the normal, and the part of the slider that follows.
    const double decay = std::exp(-pi * c), turns = std::sqrt(1.6 * k - c * c / 4);
    for (const double sign : {1.0, -1.0}) exact.push_back(decay * std::polar(1.0, 2 * pi * sign * turns));
    REQUIRE(found.size() == 8);
    CHECK(difference(found, exact) < error);
  }
}

TEST_CASE("along a line of the plane a contact has the multipliers of the contact in one direction") {
  // s = s_1 cos(theta) + ..., and a normal motion in two harmonics.
  const struct {
    double k_n, load, size;
  } cases[] = {{0, 0.3, 1}, {0.6, 0.5, 1}, {0.6, 0.12, 1}, {0.6, -0.05, 1}, {0.9, 0.2, 4}, {0.5, 0.8, 0.2}};
  const double omega = 0.9, k_t = 1.1, mu = 0.4;
  const Vector e{{0.6, 0.8}};
  const elements::Harmonics harmonics{2};
  for (const auto& [k_n, load, size] : cases) {
    CAPTURE(k_n, load, size);
    Matrix q = Matrix::Zero(harmonics.size(), 2);
    q(harmonics.cosine_index(1), 0) = size;
    q(harmonics.sine_index(2), 0) = 0.3 * size;
    q(harmonics.cosine_index(1), 1) = -0.2;
    q(harmonics.sine_index(1), 1) = 0.35;
    q(harmonics.cosine_index(2), 1) = 0.07;
    const auto line = floquet_multipliers(
        pad(elements::contact_2d(), {k_t, k_n, mu, load}, Matrix::Identity(2, 2), omega), harmonics, q);
    Matrix in_plane(q.rows(), 3);
    in_plane << q.col(0) * e.transpose(), q.col(1);
    const auto plane =
        floquet_multipliers(pad(elements::contact_3d(), {k_t, k_n, mu, load}, Matrix::Identity(3, 3), omega),
                            harmonics, in_plane);
    CHECK(plane.size() >= line.size() + 2);
    CHECK(distance(line, plane) < 1e-9);
  }
}

TEST_CASE("slip that relaxes has the force of its memory, up to the third power of its time") {
  const elements::PlaneFriction::Contact contact{900, 700, 0.4, 2};
  const elements::Harmonics harmonics{2};
  Matrix q = Matrix::Zero(harmonics.size(), 3);
  q(harmonics.cosine_index(1), 0) = 1;
  q(harmonics.sine_index(1), 1) = 0.8;
  q(harmonics.sine_index(2), 0) = 0.1;
  q(harmonics.cosine_index(1), 2) = 3e-4;
  q(harmonics.sine_index(2), 2) = 4e-4;
  DiscCourse course(contact);
  REQUIRE(course.follow(harmonics, q, 1));
  REQUIRE(course.changes().empty());
  // A disturbance, with two derivatives.
  const Eigen::Array3d rate(1.3, 0.7, 1), phase(0, 1, 2);
  const auto dq = [&](double theta, int order) {
    const Eigen::Array3d at = rate * theta + phase + order * pi / 2;
    return Matrix((at.cos() * rate.pow(order)).matrix().transpose());
  };
  const auto y_rate = [&](double theta, double y) {
    DiscCourse::Values at;
    course.at(theta, at);
    return at.rate_by_memory(0, 0) * y + (at.rate_by_q.row(0) * dq(theta, 0).transpose())(0);
  };
  Matrix memory(1, 2);
  double theta = 0.2;
  course.relax(theta, dq(theta, 0), dq(theta, 1), dq(theta, 2), memory);
  double y = memory(0, 0);
  constexpr double h = 2e-4;
  for (int i = 1; i <= 30000; ++i, theta += h) {
    const double a = y_rate(theta, y), b = y_rate(theta + h / 2, y + h / 2 * a),
                 c = y_rate(theta + h / 2, y + h / 2 * b), d = y_rate(theta + h, y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
    if (i % 1000 != 0) continue;
    const double end = theta + h;
    CAPTURE(end);
    DiscCourse::Values at;
    course.at(end, at);
    const double g = -at.rate_by_memory(0, 0);
    REQUIRE(at.relaxes);
    CHECK(g < 1e4);
    const double left_out = 20 * std::pow(g, -3);
    course.relax(end, dq(end, 0), dq(end, 1), dq(end, 2), memory);
    CHECK(std::abs(memory(0, 0) - y) < left_out);
    const Vector whole = at.by_q * dq(end, 0).transpose() + at.by_memory.col(0) * y;
    const Vector relaxed = at.relaxed_by_q * dq(end, 0).transpose() + at.by_v * dq(end, 1).transpose() +
                           at.by_a * dq(end, 2).transpose();
    CHECK((whole - relaxed).norm() < contact.k_t * left_out);
  }
}

TEST_CASE("a pad that sticks in the plane has the multipliers of its springs, and none for the slider") {
  const auto equation = pad(elements::contact_3d(), {0.8, 0.5, 0.4, 50}, Matrix::Identity(3, 3), 1.1);
  const elements::Harmonics harmonics{1};
  Matrix q = Matrix::Zero(harmonics.size(), 3);
  q(1, 0) = q(2, 1) = q(1, 2) = 1;
  const auto found = floquet_multipliers(equation, harmonics, q);
  REQUIRE(found.size() == 6);
  const double c = 0.07 / 1.1;
  std::vector<Complex> exact;
  for (const double k : {1.8, 2.1})
    for (const double sign : {1.0, -1.0})
      exact.push_back(std::exp(-pi * c) * std::polar(1.0, 2 * pi * sign * std::sqrt(k / 1.21 - c * c / 4)));
  CHECK(difference(found, exact) < 1e-12);
}

TEST_CASE("multipliers with friction in a plane are those of Newmark's method with small steps",
          "[numbers]") {
  // Its error is of second order in slip without end. The step in which a phase begins leaves one that jumps
  // about, and falls as the first power.
  const struct {
    double load, force, mu, error;
    double stiffness = 6e3;
  } cases[] = {{20, 40, 0.4, 5e-7},      {-3, 90, 0.4, 1e-4},    {8, 12, 0.4, 1e-4},
               {40, 12, 0.4, 1e-4},      {40, 25, 0.4, 1e-4},    {0.5, 25, 3, 1e-4},
               {0.5, 25, 12, 1e-4},      {8, 90, 2, 1e-4},       {20, 40, 0.4, 5e-7, 6e4},
               {20, 40, 0.4, 7e-7, 2e5}, {8, 12, 0.4, 1e-4, 6e5}};
  bool stuck = false, slipped = false;
  for (const auto& [load, force, mu, error, stiffness] : cases) {
    CAPTURE(load, force, mu, stiffness);
    const auto pad = [&](int order) {
      auto s = contacts::plane_pad(order, force, load);
      s.elements[0].values[0] = stiffness;
      s.elements[0].values[2] = mu;
      return s;
    };
    const auto motion = observables::motion_in_time(
        pad(9), {.frequency = 95, .method = observables::TimeMethod::newmark_shooting, .steps = 16000});
    REQUIRE(motion.status == observables::Status::complete);
    const auto along = [&](int order) {
      return along_harmonics::multipliers(compared_with_exact::balanced(pad(order), 95));
    };
    const auto fine = along(61);
    CHECK(difference(along(31), fine) < 1e-5);
    CHECK(difference(fine, motion.multipliers) < error);
    const double stick = motion.elements[0].stick_percent, open = motion.elements[0].open_percent;
    stuck = stuck || (stick > 5 && open > 5);
    slipped = slipped || (stick < 1 && open > 5);
  }
  CHECK((stuck && slipped));
}
