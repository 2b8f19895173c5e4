#include <arcslip/observables/prepare.hpp>

#include <arcslip/model/model.hpp>
#include <arcslip/results/text.hpp>
#include <arcslip/structure/reduction.hpp>

namespace arcslip::observables {

std::string prepare(const scene::Scene& scene, const scene::StopRequest& stop) {
  if (!scene.matrices) return {};
  try {
    const model::Model model = model::build(scene, stop);
    if (!model.reduction) return {};
    const model::Reduction& done = *model.reduction;
    return "the structure of " + std::to_string(done.rows) + " rows was reduced to " +
           std::to_string(done.kept) + " of them and " + std::to_string(done.coordinates) +
           " coordinates; error of its dynamic stiffness " + results::quantity(done.error, "-") + " up to " +
           results::quantity(scene.matrices->highest_frequency, scene::unit_name(scene.frequency_unit));
  } catch (const structure::ReductionError& error) {
    throw scene::SceneError(std::vector<scene::Fault>{{"/structure/matrices", error.what()}});
  }
}

}  // namespace arcslip::observables
