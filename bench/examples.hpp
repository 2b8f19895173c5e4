#pragma once
// The scenes of examples/.

#include <arcslip/optimize/studies.hpp>
#include <arcslip/scene/scene.hpp>
#include <arcslip/studies/catalogue.hpp>

#include <string>

namespace arcslip::bench {

/// examples/NAME/scene.json
inline scene::Scene example(const std::string& name) {
  scene::Catalogue catalogue = studies::catalogue();
  optimize::add_studies(catalogue);
  return scene::read_file(ARCSLIP_SOURCE_DIR "/examples/" + name + "/scene.json", catalogue);
}

}  // namespace arcslip::bench
