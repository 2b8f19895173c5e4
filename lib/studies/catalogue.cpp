#include <arcslip/studies/catalogue.hpp>

#include <arcslip/laws/contact/contact_2d.hpp>
#include <arcslip/laws/contact/contact_3d.hpp>
#include <arcslip/laws/hysteresis/bouc_wen.hpp>
#include <arcslip/laws/hysteresis/iwan.hpp>
#include <arcslip/laws/hysteresis/jenkins.hpp>
#include <arcslip/laws/memoryless/bilinear_spring.hpp>
#include <arcslip/laws/memoryless/coulomb.hpp>
#include <arcslip/laws/memoryless/formula_type.hpp>
#include <arcslip/laws/memoryless/gap_spring.hpp>
#include <arcslip/laws/memoryless/piecewise_linear_spring.hpp>
#include <arcslip/laws/memoryless/polynomial_coupling.hpp>
#include <arcslip/laws/memoryless/polynomial_spring.hpp>
#include <arcslip/laws/memoryless/quadratic_damper.hpp>
#include <arcslip/laws/memoryless/smooth_laws.hpp>
#include <arcslip/studies/presentation/columns.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace arcslip::elements {

std::vector<const scene::PartType*> laws() {
  return {&jenkins(),      &contact_2d(),        &contact_3d(),
          &iwan(),         &bouc_wen(),          &tanh_friction(),
          &coulomb(),      &quadratic_damper(),  &van_der_pol(),
          &cubic_spring(), &polynomial_spring(), &polynomial_coupling(),
          &gap_spring(),   &bilinear_spring(),   &piecewise_linear_spring(),
          &formula_type()};
}

}  // namespace arcslip::elements

namespace arcslip::studies {

scene::Catalogue catalogue() {
  scene::Catalogue all;
  for (const scene::PartType* law : elements::laws()) all.elements.push_back(scene::lasting(*law));
  for (const StudyKind* kind : {&frf(), &trace(), &peaks(), &folds(), &bifurcations(), &time(), &point(),
                                &modes(), &sweep(), &accuracy()})
    all.studies.push_back(scene::lasting<scene::StudyType>(*kind));
  return all;
}

void run(const scene::Scene& scene, const RunOptions& options, results::Sink& sink) {
  std::vector<results::Schema> schemas;
  for (const scene::Study& study : scene.studies)
    schemas.push_back(kind_of(*study.type).schema(scene, study, options));
  sink.begin(header(scene), schemas);
  bool any_begun = false;  // one says that it was stopped
  for (auto list = schemas.begin(); list != schemas.end(); ++list) {
    const auto in_list = [&](const results::Schema& schema) { return schema.list == list->list; };
    if (std::find_if(schemas.begin(), list, in_list) != list) continue;  // done with the first of them
    for (std::size_t i = 0; i < schemas.size(); ++i) {
      if (!in_list(schemas[i]) || (any_begun && !options.control.keep_going())) continue;
      any_begun = true;
      kind_of(*scene.studies[i].type).run(scene, scene.studies[i], options, i, sink);
    }
  }
  sink.finish();
}

results::Results run(const scene::Scene& scene, const RunOptions& options) {
  results::Collector collector;
  run(scene, options, collector);
  return std::move(collector.results);
}

}  // namespace arcslip::studies
