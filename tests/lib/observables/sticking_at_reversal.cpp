// Motions that stop at once in all sectors of a ring.
#include "catch.hpp"

#include "lib/hbm/linear/reaching.hpp"

#include <arcslip/observables/sticking_at_reversal.hpp>

#include <Eigen/Dense>

#include <numeric>
#include <span>
#include <string>

using namespace arcslip;
using continuation::Vector;
using scenes::in_matrices, scenes::ring;

namespace {

// Friction that jumps by a given ratio to the bend of its motion.
class Jump : public elements::Element {
 public:
  explicit Jump(double ratio) : ratio_(ratio) {}
  void move_to(elements::In, std::span<const double>, bool) override {}
  const Eigen::VectorXd& force() const override { return none_; }
  const Eigen::MatrixXd& jacobian() const override { return no_rates_; }
  void field_derivative(int, elements::Out dF) const override { dF.setZero(); }
  double jump_over_bend() const override { return ratio_; }

 private:
  double ratio_;
  Eigen::VectorXd none_;
  Eigen::MatrixXd no_rates_;
};

const std::string between = R"({"name": "j", "type": "jenkins", "between": ["tip", {"next": "blade"}],
  "stiffness": 0.6, "friction_coefficient": 0.4, "normal_load": 0.9})";

}  // namespace

TEST_CASE(
    "motions of a sector that shares masses stop below the inertia of the ring, of all that stop at once") {
  for (const int sectors : {2, 5, 6})
    for (const int order : {0, 1, 2, 3})
      for (const bool matrices : {false, true}) {
        CAPTURE(sectors, order, matrices);
        model::Model model = model::build(ring(sectors, order, between));
        if (matrices) model = in_matrices(model, 2);
        const Vector p = model::defaults(model);
        // In the ring.
        const int n = model.dofs, shift = sectors / std::gcd(order, sectors);
        Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n * sectors, n * sectors);
        const model::Model of_parts = model::build(ring(sectors, order, between));
        Vector force = Vector::Zero(n * sectors), first = force;
        for (int j = 0; j < sectors; ++j) {
          const auto here = Eigen::seqN(j * n, n), next = Eigen::seqN((j + 1) % sectors * n, n);
          const auto in_ring = [&](const model::Direction& d, const model::Direction& of_next) {
            Vector whole = Vector::Zero(n * sectors);
            whole(here) += Vector(d);
            if (of_next.size() > 0) whole(next) += Vector(of_next);
            return whole;
          };
          for (const auto& mass : of_parts.masses) {
            const Vector d = in_ring(mass.direction, mass.next);
            M += mass.number.value(p) * d * d.transpose();
          }
          const Vector d = in_ring(model.elements[0].directions[0], model.elements[0].next[0]);
          if (j == 0) first = d;
          if (j % shift == 0) force += d;
        }
        const double expected = 1 / first.dot(M.ldlt().solve(force));
        observables::Stops stops(model);
        Vector at = p;
        at[model::frequency] = 2;
        CHECK(stops.at_reversals(Jump(4 * expected * (1 + 1e-12)), 0, at));
        CHECK_FALSE(stops.at_reversals(Jump(4 * expected * (1 - 1e-12)), 0, at));
      }
}
