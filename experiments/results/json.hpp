#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/table.hpp"

namespace touchdown::experiments {

/// A list of a table's rows, each an object by column; undefined numbers are null.
nlohmann::ordered_json json_of(const Table& table);

/// What is wrong with a JSON file, without the library's own number of the error.
std::string reason_of(const nlohmann::json::exception& error);

}  // namespace touchdown::experiments
