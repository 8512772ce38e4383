#include "experiments/results/json_table.hpp"

#include <charconv>
#include <cmath>

namespace touchdown::experiments {

namespace {

nlohmann::ordered_json json_of(const std::string& cell) {
  double number = 0.0;
  const char* end = cell.data() + cell.size();
  const auto [rest, error] = std::from_chars(cell.data(), end, number);
  if (error != std::errc() || rest != end) return cell;
  return std::isfinite(number) ? nlohmann::ordered_json(number) : nullptr;
}

}  // namespace

nlohmann::ordered_json json_of(const Table& table) {
  auto rows = nlohmann::ordered_json::array();
  for (const std::vector<std::string>& cells : table.rows) {
    nlohmann::ordered_json row;
    for (std::size_t i = 0; i < cells.size(); ++i) row[table.header[i]] = json_of(cells[i]);
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
