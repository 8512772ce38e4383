#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace touchdown::tests {

/// An include of one of our own files by another.
struct Arrow {
  std::string from;  ///< file, relative to the source folder: "render/film/video.cpp"
  int line = 0;
  std::string to;  ///< file: "core/error.hpp"
};

/// The sources as they stand: every .cpp and .hpp below the given top-level folders.
struct House {
  std::vector<std::string> files;
  std::vector<Arrow> arrows;
};
House house_in(const std::filesystem::path& source, const std::set<std::string>& top_folders);

/// What each room may include besides itself: rooms ("core", "estimator/*" for it and all rooms
/// inside) or single files ("core/error.hpp").
using Table = std::map<std::string, std::set<std::string>>;

/// The table in docs/architecture.md: the rows between the lines "<!-- arrows -->" and
/// "<!-- /arrows -->", room first, what it may include last, names in backquotes.
Table table_in(const std::string& markdown);

/// The room of a file, and the module: "render/film" and "render/film/video".
std::string room_of(const std::string& file);
std::string module_of(const std::string& file);

/// One line for every include that the table does not allow, and for every room without a row.
std::vector<std::string> against(const Table& table, const House& house);

/// One line for every include between two modules that include each other, perhaps through others.
std::vector<std::string> circles(const House& house);

/// One line for every room of more than `most` modules.
std::vector<std::string> crowded(const House& house, std::size_t most);

}  // namespace touchdown::tests
