#pragma once

#include <filesystem>
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
  std::vector<std::string> files;  ///< relative to the source folder
  std::vector<Include> includes;
};
SourceTree source_tree_in(const std::filesystem::path& source,
                          const std::vector<std::string>& top_folders);

/// The top-level folders in their order: the first backquoted name of each row of the table between
/// the lines "<!-- folders -->" and "<!-- /folders -->" of docs/reference/architecture.md.
std::vector<std::string> folder_order_in(const std::string& markdown);

/// One line for every include of a file in a top-level folder that stands below that of the
/// including file, and for every file in a folder without a row.
std::vector<std::string> includes_against(const std::vector<std::string>& order,
                                          const SourceTree& tree);

/// One line for every include in a cycle of modules. A module is a header with its source.
std::vector<std::string> cyclic_includes(const SourceTree& tree);

}  // namespace touchdown::tests
