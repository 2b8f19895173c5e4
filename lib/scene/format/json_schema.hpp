#pragma once

#include <string>

namespace arcslip::scene {

struct Catalogue;
class SettingsKeys;

/// The format of scenes as a JSON Schema (2020-12), for completion and validation in editors. It covers keys,
/// types and bounds; references by name and consistency between values are checked by the reader only.
std::string json_schema(const Catalogue& catalogue);

namespace file {
/// Of an object with the keys of a table.
std::string object_schema(const SettingsKeys& table);
}  // namespace file

}  // namespace arcslip::scene
