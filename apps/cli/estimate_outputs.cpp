#include "apps/cli/estimate_outputs.hpp"

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"

namespace touchdown::cli {

namespace {

namespace fs = std::filesystem;

/// What the outputs of each log begin with: the log's name, behind as few names of its folders as
/// tell logs of equal names apart.
std::vector<std::string> output_names(const std::vector<std::string>& logs) {
  std::vector<fs::path> paths;
  for (const std::string& log : logs) {
    const fs::path path = absolute_path(log).lexically_normal();
    paths.push_back(path.has_filename() ? path : path.parent_path());  // "bag/"
  }
  std::vector<std::string> names;
  for (const fs::path& path : paths) {
    std::vector<fs::path> others;
    std::ranges::copy_if(paths, std::back_inserter(others), [&](const fs::path& other) {
      return other != path && other.stem() == path.stem();
    });
    const bool is_beside = std::erase_if(others, [&](const fs::path& other) {
                             return other.parent_path() == path.parent_path();
                           }) > 0;
    std::string name = (is_beside ? path.filename() : path.stem()).string();
    for (fs::path folder = path.parent_path(); !others.empty(); folder = folder.parent_path()) {
      for (fs::path& other : others) other = other.parent_path();
      const bool differs = std::erase_if(others, [&](const fs::path& other) {
                             return other.filename() != folder.filename();
                           }) > 0;
      if (differs && folder.has_filename()) name.insert(0, folder.filename().string() + "_");
    }
    names.push_back(std::move(name));
  }
  return names;
}

fs::path named_after(const std::string& name, const fs::path& output) {
  if (output.empty() || output == "-") return output;
  return output.parent_path() / (name + "_" + output.filename().string());
}

EstimateOutputs sorted_by_kind(const EstimateRequest& request) {
  EstimateOutputs result;
  const auto take = [](fs::path& path, const std::string& output) {
    if (!path.empty()) {
      throw InputError(
          fmt::format("--output: '{}' and '{}' are of one kind", path.string(), output));
    }
    path = output;
  };
  for (const std::string& output : request.outputs) {
    const fs::path extension = fs::path(output).extension();
    if (output == "-" || extension == ".csv") {
      take(result.csv, output);
    } else if (extension == ".mpack") {
      take(result.mpack, output);
    } else if (extension == ".mcap") {
      take(result.mcap, output);
    } else {
      throw InputError(
          fmt::format("--output: '{}': expected a name that ends with .csv (a table of beliefs), "
                      ".mpack (the log with beliefs in it) or .mcap (a ROS 2 bag of beliefs), or - "
                      "for standard output",
                      output));
    }
  }
  result.figure = figure_stem(request.figure);
  result.proposal = request.proposal;
  if (!request.proposal.empty() && extension_of(result.proposal) != ".csv") {
    throw InputError(
        fmt::format("--propose: '{}': expected a name that ends with .csv", request.proposal));
  }
  return result;
}

/// `seen` has the outputs so far, and the log of each.
void check(const fs::path& output, const std::string& log,
           std::map<fs::path, const std::string*>& seen) {
  if (output.empty() || output == "-") return;
  const auto [first, is_new] = seen.emplace(absolute_path(output).lexically_normal(), &log);
  if (is_new) return;
  const bool is_of_one_log = first->second == &log;
  throw InputError(fmt::format(
      "{}: would be written twice{}", output.string(),
      is_of_one_log
          ? ": name another file"
          : fmt::format(", for {} and {}: estimate one log after the other", *first->second, log)));
}

void write_file(const fs::path& path, const std::function<void(std::ostream*)>& use) {
  if (path.empty()) {
    use(nullptr);
  } else if (path == "-") {
    use(&std::cout);
  } else {
    write_stream_atomically(path, [&](std::ostream& file) { use(&file); });
  }
}

}  // namespace

fs::path figure_stem(const std::string& figure) {
  const fs::path path = figure;
  const std::set<fs::path> known = {"", ".png", ".svg", ".pdf"};
  if (!known.contains(path.extension())) {
    throw InputError(fmt::format(
        "--figure: '{}': expected a name that ends with .png; .svg and .pdf come with it", figure));
  }
  return path.parent_path() / path.stem();
}

std::vector<fs::path> figure_files(const fs::path& stem) {
  std::vector<fs::path> files;
  if (stem.empty()) return files;
  for (const char* const extension : {".png", ".svg", ".pdf", ".gp", ".dat"}) {
    files.push_back(stem.string() + extension);
  }
  return files;
}

std::vector<EstimateOutputs> estimate_outputs(const std::vector<std::string>& logs,
                                              const LogOptions& options,
                                              const std::vector<std::string>& labels,
                                              const EstimateRequest& request) {
  EstimateOutputs given = sorted_by_kind(request);
  const bool live = std::find(logs.begin(), logs.end(), "-") != logs.end();
  if (live && logs.size() > 1) throw InputError("estimate: '-', a live stream, is read alone");
  if (live && given.csv.empty()) given.csv = "-";
  std::vector<EstimateOutputs> all;
  std::map<fs::path, const std::string*> seen;
  std::vector<InputFile> inputs = {{options.model, "model"}};
  for (const std::string& file : labels) inputs.push_back({file, "file of labels"});
  for (const std::string& log : logs) add_log(log, options.mapping, inputs);
  std::vector<fs::path> files;
  const std::vector<std::string> names = output_names(logs);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    EstimateOutputs own = given;
    if (logs.size() > 1) {
      own = {named_after(names[i], given.csv), named_after(names[i], given.mpack),
             named_after(names[i], given.mcap), named_after(names[i], given.figure),
             named_after(names[i], given.proposal)};
    }
    for (const fs::path& output : {own.csv, own.mpack, own.mcap, own.figure, own.proposal}) {
      check(output, logs[i], seen);
      if (!output.empty() && output != own.figure) files.push_back(output);
    }
    for (const fs::path& file : figure_files(own.figure)) files.push_back(file);
    all.push_back(own);
  }
  check_outputs(inputs, files);
  return all;
}

void write_outputs(const EstimateOutputs& outputs,
                   const std::function<void(const EstimateStreams& streams)>& use) {
  write_file(outputs.csv, [&](std::ostream* csv) {
    write_file(outputs.mpack, [&](std::ostream* mpack) {
      write_file(outputs.mcap, [&](std::ostream* mcap) { use({csv, mpack, mcap}); });
    });
  });
}

}  // namespace touchdown::cli
