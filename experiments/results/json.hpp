#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace touchdown::experiments {

/// What is wrong with a JSON file, without the library's own number of the error.
std::string reason_of(const nlohmann::json::exception& error);

}  // namespace touchdown::experiments
