#pragma once
// Reading parts, and matrices in their place.

#include <arcslip/scene/keys/parameter_names.hpp>
#include <arcslip/scene/keys/read_places.hpp>

#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace arcslip::scene::file {

/// The key "wear_coefficient" of an element.
inline constexpr Field wear_coefficient{.name = "wear_coefficient",
                                        .unit = "m^3/J",
                                        .lower = 0,
                                        .upper = std::numeric_limits<double>::infinity(),
                                        .default_value = 0.0,
                                        .help = "volume worn for the energy dissipated"};

inline constexpr int largest_copies = 10'000;  // of matrices
/// The matrices of "structure", if it has any, from files or of a bar; the rows with names are the first
/// degrees of freedom.
std::optional<Matrices> read_matrices(const Keys& structure, FrequencyUnit unit, const FileSource& source,
                                      Dofs& dofs, Faults& faults);
std::optional<Matrices> read_bar(const Location& place, bool bends, FrequencyUnit unit,
                                 const FileSource& source, Dofs& dofs, Faults& faults);
/// The next of the values of a part. Those of formulas are NaN until resolve_formulas().
void read_value(const Location& place, const Field& field, Part& part, Faults& faults);
/// The options of a part of this type.
Settings read_options(const PartType& type, const Location& place, const Dofs& dofs, const FileSource& source,
                      Faults& faults);
/// The patches of contacts, of any of these laws.
std::vector<Part> read_patches(const Location& place, std::span<const PartType* const> laws, const Dofs& dofs,
                               const FileSource& source, Names& names, Faults& faults);
/// A section with parts of one type or, if `type` is null, of any of `types`.
std::vector<Part> read_parts(const Location& place, const PartType* type,
                             std::span<const PartType* const> types, const Dofs& dofs,
                             const FileSource& source, Names& names, Faults& faults);
/// The part that an object is; none without it.
std::vector<Part> read_one(const Location& place, const PartType& type, const Dofs& dofs,
                           const FileSource& source, Names& names, Faults& faults);

}  // namespace arcslip::scene::file
