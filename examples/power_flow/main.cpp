// Nose curves of electric networks: voltages over the load. Bus i of voltage U_i = V_i exp(i theta_i), per
// unit, sends P_i + i Q_i = U_i conj(sum_j Y_ij U_j) into its branches. Loads and generation grow by the same
// factor s = 1 + (FACTOR - 1) lambda, as in the continuation power flow of MATPOWER:
//
//   P_i + s (load - generation) = 0                  but for the reference bus, where theta_i = 0
//   Q_i + s load = 0                                 without a generator
//   clamp(V_i - v, Q - highest, Q - lowest) = 0      with one, which supplies Q = Q_i + s load
//
// A generator holds the voltage v as long as its Q is between its limits. At the highest one V_i falls below
// v, at the lowest one it rises above. The nose, beyond which there is no solution, is a fold, or a limit at
// which the load has to fall at once (Dobson and Lu, IEEE Trans. Circuits Syst. 39, 1992), a nonsmooth fold.
//
//   power_flow NETWORK.csv FACTOR [limits]

#include "network.hpp"

#include <arcslip/continuation.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

using namespace arcslip::continuation;

namespace {

struct PowerFlow {
  Network network;
  double factor = 1;

  double load(double lambda) const { return 1 + (factor - 1) * lambda; }

  // The unknowns: angles, but that of the reference bus, and voltages.
  int size() const { return 2 * network.size() - 1; }
  int angle(int i) const { return i < network.reference ? i : i - 1; }
  int voltage(int i) const { return network.size() - 1 + i; }

  // U, and S = P + i Q.
  std::pair<Eigen::VectorXcd, Eigen::VectorXcd> flows(In u) const {
    Eigen::VectorXcd U(network.size());
    for (int i = 0; i < network.size(); ++i)
      U[i] = std::polar(u[voltage(i)], i == network.reference ? 0 : u[angle(i)]);
    return {U, U.cwiseProduct((network.Y * U).conjugate())};
  }

  void residual(In u, In p, Choices& choose, Out F) const {
    const auto [U, S] = flows(u);
    const double s = load(p[0]);
    for (int i = 0; i < network.size(); ++i) {
      const Bus& bus = network.buses[i];
      if (i != network.reference) F[angle(i)] = S[i].real() + s * bus.P;
      double& F_Q = F[voltage(i)];
      F_Q = S[i].imag() + s * bus.Q;
      if (bus.generates) F_Q = choose.clamp(u[voltage(i)] - bus.voltage, F_Q - bus.highest, F_Q - bus.lowest);
    }
  }

  void jacobian(In u, Choices& made, SparseMatrix& J) const {
    const auto [U, S] = flows(u);
    std::vector<bool> holds;  // its voltage: the generator is between its limits
    std::size_t call = 0;
    for (const Bus& bus : network.buses) holds.push_back(bus.generates && made[call++] == 0);
    for (int j = 0; j < network.size(); ++j)
      for (Eigen::SparseMatrix<Complex>::InnerIterator Y(network.Y, j); Y; ++Y) {
        const int i = static_cast<int>(Y.row());
        const Complex part = U[i] * std::conj(Y.value() * U[j]), own = i == j ? S[i] : 0;
        const Complex by_angle = Complex(0, 1) * (own - part), by_voltage = (own + part) / u[voltage(j)];
        if (i != network.reference) J.coeffRef(angle(i), voltage(j)) = by_voltage.real();
        J.coeffRef(voltage(i), voltage(j)) = holds[i] ? i == j : by_voltage.imag();
        if (j == network.reference) continue;
        if (i != network.reference) J.coeffRef(angle(i), angle(j)) = by_angle.real();
        J.coeffRef(voltage(i), angle(j)) = holds[i] ? 0 : by_angle.imag();
      }
    J.makeCompressed();
  }

  // The bus whose generator is closest to where it stops, or begins, to hold its voltage.
  int at_limit(In u, double lambda) const {
    const auto [U, S] = flows(u);
    int number = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < network.size(); ++i) {
      const Bus& bus = network.buses[i];
      const double Q = S[i].imag() + load(lambda) * bus.Q - (u[voltage(i)] - bus.voltage);
      const double off = std::min(std::abs(Q - bus.lowest), std::abs(Q - bus.highest));
      if (bus.generates && off < least) number = bus.number, least = off;
    }
    return number;
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const PowerFlow flow{read_network(argv[1], argc > 3), std::atof(argv[2])};
  Functions functions;
  functions.size = flow.size();
  functions.parameters = {{"lambda", ""}};
  functions.choosing.residual = [&](In u, In p, Choices& choose, Out F) { flow.residual(u, p, choose, F); };
  functions.choosing.sparse_jacobian = [&](In u, In, Choices& made, SparseMatrix& J) {
    flow.jacobian(u, made, J);
  };
  functions.scales = Vector::Constant(flow.size(), std::sqrt(flow.size()));
  const auto problem = from_functions(std::move(functions));

  const int buses = flow.network.size();
  Vector flat = Vector::Zero(flow.size());
  flat.tail(buses).setOnes();
  const Branch branch = trace(problem, {.u = flat, .p = Vector{{0.0}}}, {.lower = 0, .upper = 4},
                              {fold_monitor(), kink_monitor()});
  for (const Event& event : branch.events) {
    const Point& at = event.point;
    Eigen::Index weakest = 0;
    const double voltage = at.u.tail(buses).minCoeff(&weakest);
    if (event.monitor == fold_event)
      std::printf("nose at lambda = %.12f, %s, lowest voltage = %.9f, of bus %d\n", at.parameter,
                  event.nonsmooth ? "by a limit" : "smooth", voltage, flow.network.buses[weakest].number);
    else
      std::printf("limit of bus %d at lambda = %.12f\n", flow.at_limit(at.u, at.parameter), at.parameter);
  }
  std::printf("branch of %ld points, %ld residuals, %ld factorizations; %s\n", branch.counts.points,
              branch.counts.residuals, branch.counts.factorizations, branch.stop.message.c_str());
  for (const std::string& warning : branch.warnings) std::printf("warning: %s\n", warning.c_str());
}
