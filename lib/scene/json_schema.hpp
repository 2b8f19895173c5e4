#pragma once

#include <string>

namespace arcslip::scene {

struct Catalogue;

/// The format of scenes as a JSON Schema (2020-12), for editors that complete and check while one writes. It
/// says which keys there are, what they hold and between which bounds; that names refer to something, and
/// that values suit each other, only the reader knows.
std::string json_schema(const Catalogue& catalogue);

}  // namespace arcslip::scene
