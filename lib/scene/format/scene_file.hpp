#pragma once

#include <arcslip/control/run_control.hpp>
#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/scene.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace arcslip::scene {

/// Reads a text, whose named files are those of `known` where their paths agree, and else relative to
/// `folder`. Throws as read_file().
Scene read(std::string_view text, const Catalogue& catalogue, const std::string& folder,
           std::vector<NamedFile> known, const control::Control& control);

/// read_file() of a file or a pipe that may block. Throws control::Interrupted if `control` ends
/// meanwhile.
Scene read_file(const std::string& path, const Catalogue& catalogue, const control::Control& control);

/// The scene with these keys in one of its studies, replacing or extending its own; null: without that key.
/// Throws SceneError.
Scene with_keys(const Scene& scene, std::size_t study, const std::vector<file::Member>& keys);

}  // namespace arcslip::scene
