#include "experiments/results/json.hpp"

#include <cmath>

namespace touchdown::experiments {

nlohmann::ordered_json json_of(const Table& table) {
  auto rows = nlohmann::ordered_json::array();
  for (const std::vector<Cell>& cells : table.rows) {
    nlohmann::ordered_json row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      auto& value = row[table.columns[i].name];
      if (const auto* const text = std::get_if<std::string>(&cells[i])) {
        value = *text;
      } else if (const auto* const count = std::get_if<std::int64_t>(&cells[i])) {
        value = static_cast<double>(*count);
      } else if (std::isfinite(std::get<double>(cells[i]))) {
        value = std::get<double>(cells[i]);
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string reason_of(const nlohmann::json::exception& error) {
  const std::string text = error.what();  // "[json.exception.type_error.302] type must be …"
  const std::size_t number_end = text.find("] ");
  return number_end == std::string::npos ? text : text.substr(number_end + 2);
}

}  // namespace touchdown::experiments
