#pragma once

#include <string>

#include "core/error.hpp"

namespace touchdown {

/// The message of the error that an action throws; "no complaint" if it throws none.
template <typename Refusal = InputError, typename Action>
std::string complaint_of(const Action& action) {
  try {
    action();
  } catch (const Refusal& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace touchdown
