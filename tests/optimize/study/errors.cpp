// All exceptions of Arcslip have one base.
#include "catch.hpp"

#include <arcslip/model/reduced_scene.hpp>
#include <arcslip/optimize/nlopt/minimize.hpp>
#include <arcslip/output/atomic_file.hpp>
#include <arcslip/scene/files/matrix_market.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/stability/floquet.hpp>
#include <arcslip/structure/reduction.hpp>
#include <arcslip/studies/catalogue.hpp>
#include <arcslip/time/event_driven/event_driven.hpp>

#include <type_traits>

using namespace arcslip;

namespace {

template <class... Exceptions>
constexpr bool are_errors = (std::is_base_of_v<Error, Exceptions> && ...);

static_assert(
    are_errors<scene::SceneError, scene::FileError, scene::ParameterError, scene::MatrixError,
               control::Interrupted, structure::ReductionError, model::NotReduced, output::WriteError>);
static_assert(are_errors<time::NoVariation, time::SingularMass, time::NotInTime, time::NotPiecewiseLinear,
                         optimize::OptionsError>);

}  // namespace

TEST_CASE("what a scene, a parameter, a file and options throw is caught as one base, with its message") {
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  scene::Scene scene;
  CHECK(message([&] { scene::set(scene, "none.value", 1); }).starts_with("unknown parameter \"none.value\""));
  CHECK(message([] { scene::read_file("/no such file", studies::catalogue()); }) != "");
  CHECK(message([] { output::write_file("/no such folder/a", [](std::ostream&) {}); }) != "");
  CHECK(message([] { optimize::algorithm("LN_NONE"); }) != "");
}
