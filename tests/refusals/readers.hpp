#pragma once

#include "tests/refusals/table.hpp"

namespace touchdown::refusals {

/// The readers of touchdown by the names that the tables use, and the robots that are made of
/// others.
Names names_of_tables();

}  // namespace touchdown::refusals
