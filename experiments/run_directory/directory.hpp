#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/tables/columns.hpp"
#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/recorded_files.hpp"
#include "experiments/run_directory/table_columns.hpp"

namespace touchdown::experiments {

/// The run directory of an experiment: `out` if given, else `runs/<experiment>/<id>`.
std::filesystem::path run_path(const std::string& experiment, const std::string& id,
                               const std::filesystem::path& out = {});

/// Names of files in the folders `recordings`, `models` and `videos` of a run directory. Errors:
/// `InputError` for a scenario with a name that leads to another folder.
std::string recording_name(const std::string& simulator, const std::string& scenario,
                           std::string_view role, std::int64_t number);
std::string model_name(const std::string& simulator, const std::string& estimator);
std::string video_name(const std::string& simulator, const std::string& scenario);

/// The directory of one experiment's results, `run_path`, with a folder per kind of file.
/// Every file appears whole or not at all.
class RunDirectory {
 public:
  /// Creates `runs/<experiment>/<id>` under the current directory and points
  /// `runs/<experiment>/latest` to it. A given `out` is used as it is, without a link. Errors:
  /// `Error` when the directory cannot be created.
  RunDirectory(const std::string& experiment, const std::string& id,
               const std::filesystem::path& out = {});

  /// Holds the lock for as long as this, or a copy of it, lives.
  void keep(const DirectoryLock& lock) { lock_ = lock; }
  void release() { lock_.reset(); }
  /// Throws `Error` if others moved or removed the directory while its lock was held.
  void require_in_place() const;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file(std::string_view folder, std::string_view name) const {
    return path_ / folder / name;
  }

  /// The same for a file that is written next: the run records it as its own. `folder` may be
  /// empty. Errors: those of `require_in_place`.
  std::filesystem::path own_file(std::string_view folder, std::string_view name) const;

  /// Reads a table of `tables/`. Errors: `Error` when it cannot be read.
  Table read_table(std::string_view name) const;
  /// Writes a file of `tables/`.
  void write_table(std::string_view name, const Table& table) const;
  /// The same for measured rows, which `results.csv` repeats: saves what their columns mean.
  /// Returns the table.
  template <typename Row>
  Table write_table(std::string_view name, const Columns<Row>& columns,
                    const std::vector<Row>& rows) const {
    Table table = columns.table(rows);
    write_table(name, table);
    write_columns(path_, name, columns.infos());
    return table;
  }

 private:
  std::filesystem::path path_;
  std::optional<DirectoryLock> lock_;
};

}  // namespace touchdown::experiments
