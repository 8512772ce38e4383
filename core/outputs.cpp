#include "core/outputs.hpp"

#include <algorithm>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown {

namespace {

namespace fs = std::filesystem;

using Identity = std::pair<dev_t, ino_t>;

/// Status of an existing file. `standard` is the descriptor that "-" stands for.
std::optional<struct stat> status_of(const fs::path& path, int standard) {
  struct stat status = {};
  const bool found =
      path == "-" ? ::fstat(standard, &status) == 0 : ::stat(path.c_str(), &status) == 0;
  return found ? std::optional(status) : std::nullopt;
}

/// Empty for terminals and pipes, which may be input and output at the same time.
std::optional<Identity> identity_of(const fs::path& path, int standard) {
  const std::optional<struct stat> status = status_of(path, standard);
  if (!status || !S_ISREG(status->st_mode)) return {};
  return Identity{status->st_dev, status->st_ino};
}

void check_against_input(const fs::path& output, const InputFile& input) {
  const std::optional<Identity> written = identity_of(output, STDOUT_FILENO);
  if (!written || written != identity_of(input.path, STDIN_FILENO)) return;
  const std::string name = output == "-" ? "standard output" : output.string();
  const std::string other = input.path == "-" ? "standard input" : input.path.string();
  throw InputError(fmt::format("{}: is the {} itself{}: name another file", name, input.what,
                               name == other ? "" : fmt::format(" ({})", other)));
}

bool is_one_file(const fs::path& a, const fs::path& b) {
  const std::optional<Identity> identity = identity_of(a, STDOUT_FILENO);
  if (identity) return identity == identity_of(b, STDOUT_FILENO);
  if (a == "-" || b == "-") return a == b;
  std::error_code ignored;
  return fs::weakly_canonical(absolute_path(a), ignored) ==
         fs::weakly_canonical(absolute_path(b), ignored);
}

void check_replaceable(const fs::path& output) {
  if (output == "-") return;
  const std::optional<struct stat> status = status_of(output, STDOUT_FILENO);
  if (!status || S_ISREG(status->st_mode) || S_ISDIR(status->st_mode)) return;
  throw InputError(fmt::format("{}: is a device or a pipe, which a file would replace: name a file",
                               output.string()));
}

}  // namespace

void check_outputs(const std::vector<InputFile>& inputs, const std::vector<fs::path>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const InputFile& input : inputs) check_against_input(outputs[i], input);
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_one_file(outputs[j], outputs[i])) continue;
      throw InputError(
          fmt::format("{}: would be written twice: name two files", outputs[i].string()));
    }
    check_replaceable(outputs[i]);
  }
  for (const fs::path& output : outputs) {
    if (output != "-") require_writable(output);
  }
}

void require_extension(const fs::path& output, const std::vector<std::string>& extensions,
                       const std::string& what) {
  const std::string extension = output.extension().string();
  if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end()) return;
  throw InputError(fmt::format("{}: expected {} with the extension {}", output.string(), what,
                               fmt::join(extensions, " or ")));
}

}  // namespace touchdown
