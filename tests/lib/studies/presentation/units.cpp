#include "catch.hpp"
#include "lib/output/support.hpp"

#include <arcslip/output/figures.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/studies/presentation/units.hpp>

#include <limits>

using namespace arcslip;

TEST_CASE(
    "a parameter's unit is its field's, that of a constant without one is that of the numbers that it "
    "gives") {
  auto scene = support::scene();
  scene.constants.push_back({.name = "load", .value = 3, .lower = 0, .upper = 10});
  scene::set_text(scene, "damper.normal_load", "load");
  CHECK(studies::parameter_unit(scene, "damper.normal_load") == "N");
  CHECK(studies::parameter_unit(scene, "load") == "N");
  CHECK(studies::parameter_unit(scene, "k.value") == "N/m");
  CHECK_THROWS_AS(studies::parameter_unit(scene, "nothing.value"), scene::ParameterError);
}

TEST_CASE("numbers are written as short as they read back") {
  CHECK(results::shortest(3) == "3");
  CHECK(results::shortest(0.01) == "0.01");
  CHECK(results::shortest(1e-12) == "1e-12");
  CHECK(results::shortest(1.0 / 3) == "0.3333333333333333");
  CHECK(results::shortest(-std::numeric_limits<double>::infinity()) == "-inf");
}

TEST_CASE("a set of parameters reads as an assignment with units") {
  CHECK(studies::assignment(support::scene(),
                            {{"damper.normal_load", 3}, {"damper.friction_coefficient", 0.5}}) ==
        "damper.normal_load = 3 N, damper.friction_coefficient = 0.5");
  CHECK(studies::assignment(support::scene(), {}).empty());
}

TEST_CASE("a file name holds nothing that a shell, gnuplot or another folder could make something of") {
  CHECK(output::file_name("frf") == "frf");
  CHECK(output::file_name("best load") == "best_load");
  CHECK(output::file_name("../../etc/passwd") == "_._.._etc_passwd");
  CHECK(output::file_name("a'b\"c`d$(e)") == "a_b_c_d__e_");
  CHECK(output::file_name("-e") == "_-e");
  CHECK(output::file_name("") == "_");
  CHECK(output::file_name(std::string(400, 'x')).size() == 100);
}
