#include <arcslip/studies/study_kind.hpp>

#include <arcslip/studies/windows.hpp>

#include <stdexcept>

namespace arcslip::studies {

results::Schema StudyKind::schema(const scene::Scene& scene, const scene::Study& study,
                                  const RunOptions& options) const {
  if (lacks_window(study))
    throw std::invalid_argument("the study \"" + study.name +
                                "\" has no window of frequencies: give one, or call propose_window()");
  results::Schema schema = compute_(scene, study, options)->schema();
  NamedValues set;  // by for_each
  for (const std::string& parameter : scene::varied_parameters(study)) set.emplace_back(parameter, 0);
  add_columns(scene, set, schema.set);
  return schema;
}

std::vector<results::FigureData> StudyKind::run(const scene::Scene& scene, const scene::Study& study,
                                                const RunOptions& options, std::size_t schema,
                                                results::Sink& sink) const {
  RunOptions how = options;
  if (timed_) how.threads = 1;
  return run_computation(scene, study, how, schema, sink, *compute_(scene, study, options));
}

const StudyKind& kind_of(const scene::StudyType& type) {
  if (const auto* kind = dynamic_cast<const StudyKind*>(&type)) return *kind;
  throw std::invalid_argument("studies of kind \"" + std::string(type.name()) + "\" compute nothing");
}

}  // namespace arcslip::studies
