#include "experiments/run_directory/test_seed_log.hpp"

#include <set>

#include "core/files.hpp"
#include "core/resources.hpp"
#include "core/table.hpp"

namespace touchdown::experiments {

std::filesystem::path test_seed_log() {
  const std::filesystem::path files = program_files().folder;
  return (is_there(files / "CMakeLists.txt") ? files : ".") / "runs" / "reserved_seeds.csv";
}

int log_evaluation(const std::filesystem::path& log, const TestSeedUse& use) {
  TextTable table{{"seed", "id", "commit"}, {}};
  if (is_there(log)) table.rows = from_csv(read_file(log)).rows;
  const std::vector<std::string> own = {std::to_string(use.seed), use.id, use.commit};
  std::set<std::vector<std::string>> others;
  bool is_logged = false;
  for (const std::vector<std::string>& row : table.rows) {
    if (row == own) {
      is_logged = true;
    } else if (!row.empty() && row.front() == own.front()) {
      others.insert(row);
    }
  }
  if (!is_logged) {
    table.rows.push_back(own);
    write_atomically(log, to_csv(table));
  }
  return static_cast<int>(others.size());
}

}  // namespace touchdown::experiments
