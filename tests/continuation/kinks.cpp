#include "catch.hpp"

#include "continuation/problems.hpp"

using namespace problems;

namespace {

// a(u) - p = 0 with a piecewise linear of slope `below` for u < 0 and `above` for u > 0.
class Broken final : public Problem {
 public:
  Broken(double below, double above) : below_(below), above_(above), parameters_{parameter("p", 0)} {}
  int size() const override { return 1; }
  std::span<const Parameter> parameters() const override { return parameters_; }
  Vector scales() const override { return Vector::Ones(1); }
  std::unique_ptr<Evaluator> evaluator() const override { return std::make_unique<At>(below_, above_); }

 private:
  class At final : public Evaluator {
   public:
    At(double below, double above) : below_(below), above_(above) {}
    Evaluated move_to(In u, In p, Needs) override {
      const double slope = u[0] < 0 ? below_ : above_;
      F_[0] = slope * u[0] - p[0];
      J_(0, 0) = slope;
      piece_ = u[0] < 0 ? 1 : 2;
      return Evaluated::ok;
    }
    const Vector& residual() const override { return F_; }
    const Jacobian& jacobian() const override { return J_; }
    void parameter_derivative(int, Out dF) const override { dF[0] = -1; }
    std::uint64_t piece() const override { return piece_; }

   private:
    double below_, above_;
    Vector F_ = Vector::Zero(1);
    Jacobian J_ = Jacobian::Zero(1, 1);
    std::uint64_t piece_ = 0;
  };
  double below_, above_;
  std::vector<Parameter> parameters_;
};

Branch through(double below, double above, double from) {
  const auto problem = std::make_shared<Broken>(below, above);
  return trace(problem, {Vector::Constant(1, from / below), Vector::Constant(1, from), 0, 1}, window(-1, 1),
               {fold_monitor()});
}

}  // namespace

TEST_CASE("a kink of any angle is passed without turning back") {
  for (double above : {1.0, 0.3, 0.1, 1e-2, 5.0, 100.0, 1e4}) {
    const Branch branch = through(1, above, -0.9137);
    CAPTURE(above);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == 1);
    CHECK(std::abs(branch.points.back().u[0] - 1 / above) < 1e-12 / above);
    CHECK(branch.events.empty());
    for (std::size_t k = 1; k < branch.points.size(); ++k)
      CHECK(branch.points[k].parameter > branch.points[k - 1].parameter);
  }
}

TEST_CASE("a nonsmooth fold is found at its kink, and says that it is nonsmooth") {
  for (double above : {-1.0, -0.2, -3.0, -0.05}) {
    const Branch branch = through(1, above, -0.9137);
    CAPTURE(above);
    CHECK(branch.stop.reason == StopReason::boundary);
    CHECK(branch.points.back().parameter == -1);
    CHECK(branch.points.back().u[0] == Approx(-1 / above));
    REQUIRE(branch.events.size() == 1);
    CHECK(branch.events[0].monitor == "fold");
    CHECK(branch.events[0].nonsmooth);
    CHECK(std::abs(branch.events[0].point.parameter) < 1e-9);
  }
}
