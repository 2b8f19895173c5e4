#pragma once
// Why a scene whose stiffnesses lie too many decades apart was not solved, in its own words.

#include <arcslip/model/model.hpp>

namespace arcslip::model {

/// The stiffest part beside the softest, springs and contacts, where one is more than 1e12 times the other: a
/// sentence with their names and values. Empty otherwise.
std::string stiffness_apart(const Model& model, const continuation::Vector& p);

}  // namespace arcslip::model
