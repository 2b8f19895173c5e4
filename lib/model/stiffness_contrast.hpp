#pragma once
// Diagnosis of scenes with too large a ratio of stiffnesses.

#include <arcslip/model/model.hpp>

namespace arcslip::model {

/// A sentence with the names and values of the stiffest and the softest part, springs and contacts, if their
/// ratio exceeds 1e12. Empty otherwise.
std::string stiffness_apart(const Model& model, const continuation::Vector& p);

}  // namespace arcslip::model
