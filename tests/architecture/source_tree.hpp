#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace touchdown::tests {

/// An include of one of the project's files by another.
struct Include {
  std::string from;  ///< including file, relative to the source folder: "render/film/video.cpp"
  int line = 0;      ///< from 1
  std::string to;    ///< included file: "core/error.hpp"
};

/// Every .cpp and .hpp below some top-level folders, sorted, and all their includes.
struct SourceTree {
  std::vector<std::string> files;
  std::vector<Include> includes;
};
SourceTree source_tree_in(const std::filesystem::path& source,
                          const std::set<std::string>& top_folders);

/// Maps each folder to what it may include besides itself: folders ("core", or "estimator/*" for
/// estimator and all folders inside) or single files ("core/error.hpp").
using DependencyTable = std::map<std::string, std::set<std::string>>;

/// Reads the table in docs/reference/architecture.md: the rows between the lines "<!-- dependencies
/// -->" and
/// "<!-- /dependencies -->". The first column is the folder. The last lists what it may include,
/// in backquotes.
DependencyTable dependency_table_in(const std::string& markdown);

/// The folder of a file, and its module: "render/film" and "render/film/video".
std::string folder_of(const std::string& file);
std::string module_of(const std::string& file);

/// One line for every include that the table does not allow, and for every folder without a row.
std::vector<std::string> forbidden_includes(const DependencyTable& table, const SourceTree& tree);

/// One line for every include in a cycle of modules.
std::vector<std::string> cyclic_includes(const SourceTree& tree);

/// One line for every folder of more than `most` modules.
std::vector<std::string> crowded_folders(const SourceTree& tree, std::size_t most);

}  // namespace touchdown::tests
