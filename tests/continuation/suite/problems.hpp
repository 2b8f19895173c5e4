#pragma once
// Problems F(u, p) = 0 with known folds and closed forms, for tests and for counts of work. Each has its
// analytic Jacobian and parameter derivatives. Numbers and sources: tests/reference/continuation.json.
//
// "test_con N" is problem N of J. Burkardt's TEST_CON, the sample problems of PITCON (Rheinboldt and
// Burkardt, ACM Trans. Math. Softw. 9, 1983).

#include <arcslip/continuation/problem/problem_from_functions.hpp>

#include <cstdint>
#include <functional>

namespace suite {

using arcslip::continuation::In;
using arcslip::continuation::Out;
using arcslip::continuation::Parameter;
using arcslip::continuation::Problem;
using arcslip::continuation::Vector;
using MatrixOut = Eigen::Ref<Eigen::MatrixXd>;
using ProblemPtr = std::shared_ptr<const Problem>;

inline Parameter parameter(std::string name, double value, double scale = 1) {
  return {std::move(name), "", value, scale, -1e300, 1e300};
}

// Normal forms (normal_forms.cpp)

/// mu + lambda x - x^3. Folds at mu = -+2 (lambda/3)^(3/2).
ProblemPtr cusp();
/// lambda u - u^3 + eps; parameters lambda, eps.
ProblemPtr pitchfork(double eps = 0);
/// lambda u - u^2 + eps; parameters lambda, eps.
ProblemPtr transcritical(double eps = 0);
/// The imperfect pitchfork in y_0 and y_i = (i + 1) y_0^2 for 0 < i < n, in coordinates u = Q y turned by a
/// Householder reflection Q; its equations turned alike.
ProblemPtr turned_pitchfork(int n, double eps);
/// The vector u of the point y_0 of the above.
Vector turned_pitchfork_state(int n, double y0);
/// u^2 + lambda^2 - 1: the unit circle; a closed branch.
ProblemPtr circle();
/// Brusselator, steady states: A - (B + 1) x + x^2 y, B x - x^2 y. x = A, y = B / A; Hopf point at B = 1 +
/// A^2.
ProblemPtr brusselator();

// Small systems (small_systems.cpp)

/// test_con 1 (Freudenstein and Roth 1963), parameter x3.
ProblemPtr freudenstein_roth();
/// test_con 2 (Boggs 1971): G(x) + (lambda - 1) G(start), G = (x1^2 - x2 + 1, x1 - cos(pi x2 / 2)).
ProblemPtr boggs(const Eigen::Vector2d& start);
/// test_con 3 (Powell 1970): the same with G = (10^4 x1 x2 - 1, e^-x1 + e^-x2 - 1.0001).
ProblemPtr powell(const Eigen::Vector2d& start);
/// test_con 4 (Broyden 1969): G = (sin(x1 x2) / 2 - x2 / (4 pi) - x1 / 2, (1 - 1/(4 pi)) (e^(2 x1) - e) + e
/// x2 / pi
/// - 2 e x1). TEST_CON prints another first equation, of which its own target is not a zero.
ProblemPtr broyden(const Eigen::Vector2d& start);
/// test_con 5 (Wacker, Zarzer and Zulehner 1978), parameters x4 and A.
ProblemPtr wacker(double A);
/// test_con 7 (Rheinboldt 1980): (I + L) x + 100 x / (1 + x + x^2) - lambda, L the Laplacian of a chain of n
/// cells. The branch of equal x has its folds where (1 + x + x^2)^2 + 100 (1 - x^2) = 0.
ProblemPtr cell_kinetics(int n = 5);
/// test_con 15 (Poenisch and Schwetlick 1981): voltages of a trigger circuit over its input voltage. R0 =
/// 10^4 and the matrix of the resistors: so the limit points are Melhem's, which they are not as TEST_CON
/// prints it.
ProblemPtr trigger_circuit();
/// AUTO-07p's demo ab, steady states: -x + p1 (1 - x) e^y, -y + p1 p2 (1 - x) e^y - p3 y.
ProblemPtr ab();

// Structures and vibration (structures.cpp)

/// test_con 6 (Mehra, Kessel and Carroll 1977; Rheinboldt's coefficients): roll, pitch, yaw, angle of attack
/// and sideslip over aileron, elevator and rudder.
ProblemPtr aircraft(double elevator);
/// test_con 8 (Riks 1972): three springs with one movable end; parameters load_x, load_y, load_z.
ProblemPtr riks();
/// test_con 9 (Oden): two bars; parameters load and its angle. At angle 0 the folds are at load = +-16 /
/// sqrt(27).
ProblemPtr oden(double angle);
/// test_con 20 (Poston and Stewart 1978): a buckling spring; u = (length, angle), parameters lambda, mu.
ProblemPtr buckling_spring(double mu);
/// x'' + d x' + x + alpha x^3 = g cos(omega t) in one harmonic, x = a cos + b sin; parameters omega, g, d,
/// alpha.
ProblemPtr duffing_1harmonic(double g, double d = 0.1, double alpha = 1);
/// x'' + 0.02 x' + x + 0.5 x^3 + Jenkins (kd = 0.5, mu = 0.5, normal load Fn) = 0.5 cos(omega t) in one
/// harmonic, by the describing function of the element; parameters omega, Fn.
ProblemPtr duffing_jenkins_1harmonic(double omega, double Fn);

// Boundary value problems (boundary_values.cpp)

/// u'' + lambda e^u = 0, u(0) = u(1) = 0: collocation at Chebyshev's points, n inner ones.
ProblemPtr bratu_chebyshev(int n);
/// The same by differences of three points, n inner ones, of order 2 or (Numerov) 4.
ProblemPtr bratu_differences(int n, int order);
/// LOCA's ChanProblem, n nodes; parameters alpha, beta.
ProblemPtr chan(int n);
/// test_con 13 (Simpson 1975): the Laplacian of a square by nine points, m x m inner ones. rational: f = (100
/// + 100 u + 51 u^2) / (100 + u^2), otherwise e^u.
ProblemPtr simpson(int m, bool rational);
/// test_con 14 (Keller): diffusion and kinetics in a sphere, m points.
ProblemPtr keller(int m);
/// test_con 16 (Moore and Spence 1980): heat and mass transfer in a catalyst, an integral equation by the
/// trapezoidal rule on m points.
ProblemPtr moore_spence(int m);
/// test_con 10 (Rheinboldt 1976): torsion of a square rod, phi(s) = e^(5 s), m x m inner points, linear
/// triangles. Its energy is convex: one solution for each load, without a fold.
ProblemPtr torsion(int m);

// Other views of a problem (views.cpp)

/// Unknown i and parameter k change places, so that folds in u_i can be looked for.
ProblemPtr exchanged(ProblemPtr problem, int unknown, int parameter);
/// Unknowns measured in units of 1 / in_u, parameter k in units of 1 / in_p: u' = in_u u, p_k' = in_p p_k.
ProblemPtr rescaled(ProblemPtr problem, double in_u, int parameter, double in_p);

/// The same problem, which says on which smooth piece it is.
ProblemPtr in_pieces(ProblemPtr problem, std::function<std::uint64_t(In u, In p)> piece);

}  // namespace suite
