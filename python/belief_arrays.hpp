#pragma once

#include <string>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "python/arrays.hpp"

namespace touchdown::python {

/// Arrays that view beliefs by step: `p_contact` and `contact` (left and right wheel),
/// `p_any_wheel`, `p_both_wheels`, `status` (its number).
py::dict arrays_of(std::vector<Belief> beliefs);

/// The inverse. `given` holds such arrays (`p_contact` or `contact` suffices), or is one array of
/// probabilities or decisions, per wheel or for the robot. By default, contact is p ≥ 0.5 and the
/// wheels are independent. `source` names the estimator in error messages.
/// Errors: `InputError` for other shapes, and for numbers that are no probabilities.
std::vector<Belief> beliefs_of(const py::object& given, std::size_t steps,
                               const std::string& source);

}  // namespace touchdown::python
