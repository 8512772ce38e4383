#include "experiments/results/json.hpp"

namespace touchdown::experiments {

std::string reason_of(const nlohmann::json::exception& error) {
  const std::string text = error.what();  // "[json.exception.type_error.302] type must be …"
  const std::size_t number_end = text.find("] ");
  return number_end == std::string::npos ? text : text.substr(number_end + 2);
}

}  // namespace touchdown::experiments
