#pragma once

#include <cstdint>
#include <span>

#include "logs/log/row.hpp"
#include "logs/mapping/mapping.hpp"

namespace touchdown::logs {

/// The record of a row with the numbers of `LogMapping::columns`, in Upkie's conventions. `k`
/// counts the rows, for logs without a clock.
LogValues log_values(const LogMapping& mapping, std::uint64_t k, std::span<const double> row);

/// Marks the values that such records have.
LogPresence log_presence(const LogMapping& mapping);

}  // namespace touchdown::logs
