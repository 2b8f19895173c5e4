#pragma once
// Values as they stand in a scene file.

#include <arcslip/scene/keys/json_tree.hpp>
#include <arcslip/scene/scene.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace arcslip::scene::file {

Node node(std::string_view text);
Node node(double value);
Node node(int value);
Node node(const std::vector<double>& values);
Node node(const std::vector<std::string>& texts);

/// "at", "between" or "direction", whichever is the plainest that gives the same terms in the same order.
Member place_member(const Direction& direction, const std::vector<std::string>& dofs);

/// A value as JSON on one line: `1e-9`, `"shooting"`.
std::string json_text(const Node& value);

/// A scene with every default.
Node tree(const Scene& scene);

}  // namespace arcslip::scene::file
