#pragma once

#include <arcslip/control/stop_request.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace arcslip::scene {

/// read_file() of a file or a pipe that may block. Throws Interrupted if `stop` is requested meanwhile.
Scene read_file(const std::string& path, const Catalogue& catalogue, const StopRequest& stop);

/// The scene with these keys in one of its studies, replacing or extending its own; null: without that key.
/// Throws SceneError.
Scene with_keys(const Scene& scene, std::size_t study, const std::vector<file::Member>& keys);

}  // namespace arcslip::scene
