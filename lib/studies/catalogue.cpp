#include <arcslip/studies/catalogue.hpp>

#include <arcslip/studies/columns.hpp>

#include <utility>

namespace arcslip::studies {

scene::Catalogue catalogue() {
  return {{&frf(), &trace(), &peaks(), &folds(), &time(), &point()}};
}

results::Results run(const scene::Scene& scene, const scene::RunOptions& options) {
  results::Results all{header(scene), {}, {}};
  bool go_on = true;
  scene::RunOptions watched = options;
  if (options.progress)
    watched.progress = [&](const results::Progress& now) { return go_on = options.progress(now); };
  for (const scene::Study& study : scene.studies)
    if (go_on) append(study.type->run(scene, study, watched).results, all);
  return all;
}

}  // namespace arcslip::studies
