#pragma once
// Patches of contacts: a friction law at each row of a CSV file, with the parameters of the patch in common.
// With the area A of a row, its initial gap g and pressure p, the fields of the law there are
//
//   stiffnesses and dampings   A times that of the patch, which is per area
//   normal_load                A (pressure_factor p - normal_stiffness g), pressure_factor in its place
//   all others                 those of the patch
//
// A patch may have every law with a field normal_load.

#include <arcslip/scene/part_type.hpp>
#include <arcslip/scene/scene.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace arcslip::scene {

/// One contact of a patch.
struct PatchRow {
  std::string name;  // of its element: "root.1"
  std::vector<Direction> directions;
  double area = 0, gap = 0, pressure = 0;        // m^2, m, Pa
  std::optional<std::array<double, 2>> place{};  // on the surface, m; only for figures
  friend bool operator==(const PatchRow&, const PatchRow&) = default;
};

/// What field `from` of the patch adds to a field of a row: factor times its value.
struct PatchShare {
  std::size_t field, from;
  double factor;
};

/// The options of a part of Scene::patches.
struct PatchOptions {
  const PartType* law = nullptr;
  Settings law_options{};
  NamedFile file{};
  bool details = true;  // whether results have each element, and not the totals alone
  std::vector<PatchRow> rows{};
  std::vector<Field> fields{};  // of the patch, in the order of those of the law

  /// Of the fields of one row.
  std::vector<PatchShare> shares(const PatchRow& row) const;
  friend bool operator==(const PatchOptions& a, const PatchOptions& b) {
    return a.law == b.law && a.law_options == b.law_options && a.file == b.file && a.details == b.details &&
           a.rows == b.rows;
  }
};

/// The type of all patches.
const PartType& patch_type();

/// The element of one row.
Part patch_element(const Part& patch, const PatchRow& row);

/// The fields of a patch of this law; none: it may have no patch.
std::vector<Field> patch_fields(const PartType& law, const Settings& options);

}  // namespace arcslip::scene
