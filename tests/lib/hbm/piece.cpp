#include "catch.hpp"

#include "lib/hbm/scenes.hpp"

#include <arcslip/hbm/problem.hpp>

using namespace arcslip;
using continuation::Evaluated;
using continuation::Needs;
using continuation::PieceTest;
using continuation::Vector;

TEST_CASE("a test of a piece agrees with the piece of the residual, and one of a part is right outside") {
  // Friction, a gap and cubic springs; contacts with two dofs, which lift off or not.
  for (const char* name : {"gap_limited_chain", "under_platform_damper", "rubbing_pad"}) {
    const scene::Scene s = scenes::example(name);
    const auto model = std::make_shared<const model::Model>(model::build(s));
    const double frequency = model->parameters[model::frequency].value;
    const hbm::HbmProblem problem(model, model->harmonics, 1, frequency > 0 ? frequency : 1);
    const auto tests = problem.hbm_evaluator(), fresh = problem.hbm_evaluator();
    const Vector p = hbm::parameters_at(problem, frequency > 0 ? frequency : 1);
    int inside = 0, outside = 0, unseen = 0;
    std::srand(1);
    for (int line = 0; line < 60; ++line) {
      const Vector u = Vector::Random(problem.size()) * std::pow(10.0, line % 6 - 5);
      const Vector along = Vector::Random(problem.size()) * u.norm() / std::sqrt(1.0 * problem.size());
      REQUIRE(fresh->move_to(u, p, Needs::residual) == Evaluated::ok);
      const std::uint64_t piece = fresh->piece();
      for (double way = 1; way > 1e-6; way /= 4) {
        const Vector v = u + way * along;
        REQUIRE(fresh->move_to(v, p, Needs::residual) == Evaluated::ok);
        const bool expected = fresh->piece() == piece;
        bool whole = !expected, part = !expected;
        CAPTURE(name, line, way);
        REQUIRE(tests->test_piece(v, p, piece, PieceTest::part, part) == Evaluated::ok);
        CHECK((part || !expected));
        REQUIRE(tests->test_piece(v, p, piece, PieceTest::whole, whole) == Evaluated::ok);
        CHECK(whole == expected);
        (expected ? inside : outside) += 1;
        unseen += part && !expected;
      }
      REQUIRE(tests->move_to(u, p, Needs::jacobian) == Evaluated::ok);
      REQUIRE(fresh->move_to(u, p, Needs::jacobian) == Evaluated::ok);
      CHECK(tests->residual() == fresh->residual());
      CHECK(std::get<Eigen::MatrixXd>(tests->jacobian()) == std::get<Eigen::MatrixXd>(fresh->jacobian()));
    }
    CAPTURE(name, inside, outside, unseen);
    CHECK(inside > 50);
    CHECK(outside > 50);
    CHECK(unseen < outside);
    bool any = true;
    CHECK(tests->test_piece(Vector::Constant(problem.size(), std::nan("")), p, 0, PieceTest::whole, any) ==
          Evaluated::failed);
    Vector standing = p;
    standing[model::frequency] = 0;
    CHECK(tests->test_piece(Vector::Zero(problem.size()), standing, 0, PieceTest::whole, any) ==
          Evaluated::outside_domain);
  }
}
