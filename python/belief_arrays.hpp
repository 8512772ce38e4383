#pragma once

#include <string>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "python/arrays.hpp"

namespace touchdown::python {

/// Beliefs by step, by views of them: `p_contact` and `contact` (left and right wheel),
/// `p_any_wheel`, `p_both_wheels`, `status` (its number).
py::dict arrays_of(std::vector<Belief> beliefs);

/// The inverse, of what anybody says: such arrays, of which `p_contact` or `contact` is enough, or
/// one array of probabilities or decisions, of both wheels or of the robot. Decisions are
/// p ≥ 0.5 and wheels independent where nothing else is said. `who` says it, for complaints.
/// Errors: `InputError` for other shapes, and for probabilities that are none.
std::vector<Belief> beliefs_of(const py::object& said, std::size_t steps, const std::string& who);

}  // namespace touchdown::python
