#pragma once
// Values and columns of results as objects of Python.

#include <arcslip/results/result.hpp>

#include <nanobind/nanobind.h>

namespace arcslip::python {

/// None, a bool, int, float, str, list, dict, or an array for a list of numbers. Numbers that are not finite
/// are None, as in JSON, and in arrays NaN.
nanobind::object as_object(const results::Value& value);
nanobind::dict as_dict(const results::Object& object);

/// Sets what is missing in the columns of numbers to NaN.
void mark_missing(results::Rows& rows);

/// The cells of a column. Numbers, and whole numbers of which none is missing, are an array that shares their
/// memory, which `owner` keeps; flags are copied. Where one of these is missing, they are numbers with NaN.
/// Texts and values are lists with None.
nanobind::object as_column(const results::Cells& cells, nanobind::handle owner);

}  // namespace arcslip::python
