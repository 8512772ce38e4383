#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/columns.hpp"
#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/store.hpp"

namespace touchdown::experiments {

/// The columns of tables (`Column`) in the store are of this kind, and have the table's name.
inline constexpr std::string_view column_parts = "columns";

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
  /// What this build computed of this experiment.
  const Store& store() const { return store_; }
  std::filesystem::path file(std::string_view folder, std::string_view name) const {
    return path_ / folder / name;
  }

  /// The same for a file that is written next: the run records it as its own. `folder` may be
  /// empty. Errors: those of `require_in_place`.
  std::filesystem::path own_file(std::string_view folder, std::string_view name) const;

  /// Writes a table to `tables/`, and keeps it for its readers in this process and in copies of
  /// this. Returns it as `read_table` does.
  const Table& write_table(std::string_view name, Table table) const;
  /// The same for measured rows, which `results.csv` repeats. Saves the columns.
  const Table& write_measured(std::string_view name, Table table) const {
    store_.put(column_parts, name, table.columns);
    return write_table(name, std::move(table));
  }
  template <typename Row>
  const Table& write_table(std::string_view name, const Columns<Row>& columns,
                           const std::vector<Row>& rows) const {
    return write_measured(name, columns.table(rows));
  }
  /// A table of `tables/`: as it was written, or else read once from its file. The reference is
  /// valid until the table is written again. Errors: `Error` when it cannot be read.
  const Table& read_table(std::string_view name) const;

 private:
  std::filesystem::path path_;
  Store store_;
  std::optional<DirectoryLock> lock_;
  using Tables = std::map<std::string, Table, std::less<>>;
  std::shared_ptr<Tables> tables_ = std::make_shared<Tables>();  ///< by file name
};

}  // namespace touchdown::experiments
