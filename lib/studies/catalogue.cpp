#include <arcslip/studies/catalogue.hpp>

#include <arcslip/elements/law.hpp>
#include <arcslip/studies/columns.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace arcslip::studies {

scene::Catalogue catalogue() {
  return {elements::laws(),
          {&frf(), &trace(), &peaks(), &folds(), &bifurcations(), &time(), &point(), &modes(), &sweep(),
           &accuracy()}};
}

void run(const scene::Scene& scene, const scene::RunOptions& options, results::Sink& sink) {
  std::vector<results::Schema> schemas;
  for (const scene::Study& study : scene.studies)
    schemas.push_back(study.type->schema(scene, study, options));
  sink.begin(header(scene), schemas);
  bool go_on = true;
  scene::RunOptions watched = options;
  if (options.progress)
    watched.progress = [&](const results::Progress& now) { return go_on = options.progress(now); };
  for (auto list = schemas.begin(); list != schemas.end(); ++list) {
    const auto in_list = [&](const results::Schema& schema) { return schema.list == list->list; };
    if (std::find_if(schemas.begin(), list, in_list) != list) continue;  // done with the first of them
    for (std::size_t i = 0; i < schemas.size() && go_on; ++i)
      if (in_list(schemas[i])) scene.studies[i].type->run(scene, scene.studies[i], watched, i, sink);
  }
  sink.finish();
}

results::Results run(const scene::Scene& scene, const scene::RunOptions& options) {
  results::Collector collector;
  run(scene, options, collector);
  return std::move(collector.results);
}

}  // namespace arcslip::studies
