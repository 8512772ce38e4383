#include "experiments/submissions/belief_folder.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/yaml.hpp"
#include "recordings/log/beliefs.hpp"

namespace touchdown::experiments {

namespace {

namespace fs = std::filesystem;

bool is_hidden(const fs::path& name) {
  return std::any_of(name.begin(), name.end(),
                     [](const fs::path& part) { return part.string().starts_with('.'); });
}

/// The relative paths of all files below the folder that are not hidden, sorted.
std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> names;
  std::error_code ignored;
  for (const fs::path& entry : entries_below(folder)) {
    const fs::path name = entry.lexically_relative(folder);
    if (fs::is_regular_file(entry, ignored) && !is_hidden(name)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

Submission submission_of_folder(const fs::path& folder, const std::vector<ExportedRun>& runs) {
  std::map<std::string, std::size_t> number;
  for (std::size_t i = 0; i < runs.size(); ++i) number.emplace(runs[i].name, i);
  std::map<std::size_t, fs::path> found;
  Submission all;
  for (const fs::path& name : files_below(folder)) {
    const fs::path path = folder / name;
    const std::string stem = (name.parent_path() / name.stem()).generic_string();
    const auto run = number.find(stem);
    if (run == number.end()) {
      std::vector<std::string> known;
      for (const auto& [one, index] : number) known.push_back(one);
      throw InputError(fmt::format("{}: the benchmark has no run of this name{}", path.string(),
                                   did_you_mean(stem, known)));
    }
    const auto [there, is_new] = found.emplace(run->second, path);
    if (!is_new) {
      throw InputError(fmt::format("{}: {} is about the same run: expected one of them",
                                   path.string(), there->second.string()));
    }
  }
  for (const auto& [index, path] : found) {
    if (runs[index].task) {
      all.files.push_back({path, index});
    } else {
      ++all.about_fitted;
    }
  }
  return all;
}

Submission submission_of_file(const fs::path& file, const std::vector<ExportedRun>& runs) {
  Submission all;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].task) continue;
    known.push_back(fs::path(runs[i].name).filename().string());
    if (known.back() == file.stem()) all.files.push_back({file, i});
  }
  if (all.files.size() == 1) return all;
  if (all.files.empty()) {
    throw InputError(fmt::format("{}: the benchmark has no test run of this name{}", file.string(),
                                 did_you_mean(file.stem().string(), known)));
  }
  throw InputError(fmt::format(
      "{}: the benchmark has {} runs of this name, '{}' and '{}' among them: expected a folder "
      "with a file for each",
      file.string(), all.files.size(), runs[all.files[0].run].name, runs[all.files[1].run].name));
}

}  // namespace

Submission submission_in(const fs::path& beliefs, const std::vector<ExportedRun>& runs) {
  if (!is_there(beliefs)) {
    throw InputError(fmt::format("{}: no such file or folder", beliefs.string()));
  }
  Submission all =
      is_folder(beliefs) ? submission_of_folder(beliefs, runs) : submission_of_file(beliefs, runs);
  if (all.files.empty()) {
    throw InputError(
        fmt::format("{}: holds no beliefs about a test run: expected files such as {}.csv",
                    beliefs.string(), runs.back().name));
  }
  return all;
}

void require_sound(const std::vector<BeliefFile>& files, const ShouldContinue& should_continue) {
  std::vector<std::string> complaints(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    if (!should_continue()) throw Stopped();
    try {
      static_cast<void>(recordings::read_beliefs(files[i].path));
    } catch (const InputError& error) {
      complaints[i] = error.what();
    }
  });
  for (const std::string& complaint : complaints) {
    if (!complaint.empty()) throw InputError(complaint);
  }
}

}  // namespace touchdown::experiments
