#include "experiments/run_directory/test_seed_log.hpp"

#include <set>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/table.hpp"

namespace touchdown::experiments {

int log_evaluation(const std::filesystem::path& run_directory, const TestSeedUse& touch) {
  const std::filesystem::path ledger =
      std::filesystem::absolute(run_directory).parent_path() / "reserved_seeds.csv";
  Table table{{"seed", "id", "commit"}, {}};
  if (std::filesystem::exists(ledger)) table.rows = from_csv(read_file(ledger)).rows;
  const std::vector<std::string> own = {std::to_string(touch.seed), touch.id, touch.commit};
  std::set<std::vector<std::string>> others;
  bool is_noted = false;
  for (const std::vector<std::string>& row : table.rows) {
    if (row == own) {
      is_noted = true;
    } else if (!row.empty() && row.front() == own.front()) {
      others.insert(row);
    }
  }
  if (!is_noted) {
    table.rows.push_back(own);
    write_atomically(ledger, to_csv(table));
  }
  return static_cast<int>(others.size());
}

}  // namespace touchdown::experiments
