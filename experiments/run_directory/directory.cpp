#include "experiments/run_directory/directory.hpp"

#include <random>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/progress.hpp"
#include "experiments/run_directory/own_files.hpp"

namespace touchdown::experiments {

namespace fs = std::filesystem;

namespace {

/// Points `link` to `target`; replaces an existing link in one step.
void point(const fs::path& link, const fs::path& target) {
  // Shards start at the same time, some of them on other machines.
  const fs::path temporary =
      link.parent_path() / fmt::format(".latest.{}.{:08x}", ::getpid(), std::random_device{}());
  std::error_code ignored;
  fs::remove(temporary, ignored);
  fs::create_directory_symlink(target, temporary);
  fs::rename(temporary, link);
}

/// The scenario's name may come from an untrusted recording.
const std::string& name_word(const std::string& scenario) {
  if (!is_name_word(scenario)) {
    throw InputError(fmt::format("a scenario's name: {}", expected_name_word));
  }
  return scenario;
}

}  // namespace

fs::path run_path(const std::string& experiment, const std::string& id, const fs::path& out) {
  return out.empty() ? fs::path("runs") / experiment / id : out;
}

std::string recording_name(const std::string& simulator, const std::string& scenario,
                           std::string_view role, std::int64_t number) {
  return fmt::format("{}_{}_{}_{:03}.mpack", simulator, name_word(scenario), role, number);
}

std::string model_name(const std::string& simulator, const std::string& estimator) {
  return fmt::format("{}_{}.npz", simulator, estimator);
}

std::string video_name(const std::string& simulator, const std::string& scenario) {
  return fmt::format("{}_{}.mp4", simulator, name_word(scenario));
}

RunDirectory::RunDirectory(const std::string& experiment, const std::string& id,
                           const fs::path& out)
    : path_(run_path(experiment, id, out)), store_(path_, key_of(id, build_fingerprint())) {
  try {
    fs::create_directories(path_);
  } catch (const fs::filesystem_error& error) {
    throw Error(fmt::format("{}: cannot be created: {}", path_.string(), error.code().message()));
  }
  if (!out.empty()) return;
  try {
    point(path_.parent_path() / "latest", id);
  } catch (const fs::filesystem_error& error) {  // exFAT, SMB
    print_message(fmt::format("touchdown: {} does not lead to this run: {}\n",
                              (path_.parent_path() / "latest").string(), error.code().message()));
  }
}

void RunDirectory::require_in_place() const {
  if (!lock_ || lock_->is_in_place()) return;
  throw Error(fmt::format(
      "{}: was moved or removed during the run: the same command continues with --out and its "
      "new place",
      path_.string()));
}

fs::path RunDirectory::own_file(std::string_view folder, std::string_view name) const {
  require_in_place();
  return record_file(path_, fs::path(folder) / name);
}

const Table& RunDirectory::write_table(std::string_view name, Table table) const {
  write_atomically(own_file("tables", name), to_csv(table));
  return tables_->insert_or_assign(std::string(name), std::move(table)).first->second;
}

const Table& RunDirectory::read_table(std::string_view name) const {
  const auto known = tables_->find(name);
  if (known != tables_->end()) return known->second;
  const auto columns = store_.find<std::vector<Column>>(column_parts, name);
  Table table = table_of(from_csv(read_file(path_ / "tables" / name)),
                         columns.value_or(std::vector<Column>()));
  return tables_->emplace(name, std::move(table)).first->second;
}

}  // namespace touchdown::experiments
