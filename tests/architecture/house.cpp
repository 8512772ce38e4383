#include "tests/architecture/house.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>

namespace touchdown::tests {

namespace fs = std::filesystem;

namespace {

bool is_allowed(const Table& table, const std::string& from, const std::string& to_file) {
  const std::string to = room_of(to_file);
  const auto row = table.find(from);
  if (from == to) return true;
  if (row == table.end()) return false;
  return std::any_of(row->second.begin(), row->second.end(), [&](const std::string& name) {
    if (name == to || name == to_file) return true;
    if (!name.ends_with("/*")) return false;
    const std::string root = name.substr(0, name.size() - 2);
    return to == root || to.starts_with(root + "/");
  });
}

std::string place(const Arrow& arrow) {
  return arrow.from + ":" + std::to_string(arrow.line) + ": includes \"" + arrow.to + "\"";
}

}  // namespace

House house_in(const fs::path& source, const std::set<std::string>& top_folders) {
  House house;
  for (const std::string& folder : top_folders) {
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".cpp" && ending != ".hpp") continue;
      house.files.push_back(fs::relative(entry.path(), source).string());
    }
  }
  std::sort(house.files.begin(), house.files.end());
  static const std::regex include(R"re(^#include "([^"]+)".*)re");
  for (const std::string& file : house.files) {
    std::ifstream text(source / file);
    std::smatch match;
    int number = 0;
    for (std::string line; std::getline(text, line);) {
      ++number;
      if (std::regex_match(line, match, include)) house.arrows.push_back({file, number, match[1]});
    }
  }
  return house;
}

Table table_in(const std::string& markdown) {
  Table table;
  std::istringstream text(markdown);
  static const std::regex name("`([a-z_/*.]+)`");
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (line == "<!-- arrows -->" || line == "<!-- /arrows -->") inside = line[5] == 'a';
    static const std::regex row(R"(^\| `([^`]+)` \|.*\|([^|]*)\|$)");
    std::smatch cells;
    if (!inside || !std::regex_match(line, cells, row)) continue;
    const std::string last = cells[2];
    std::set<std::string>& allowed = table[cells[1]];
    for (std::sregex_iterator match(last.begin(), last.end(), name), end; match != end; ++match) {
      allowed.insert((*match)[1]);
    }
  }
  return table;
}

std::string room_of(const std::string& file) {
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? "" : file.substr(0, slash);
}

std::string module_of(const std::string& file) { return file.substr(0, file.rfind('.')); }

std::vector<std::string> against(const Table& table, const House& house) {
  std::vector<std::string> lines;
  std::set<std::string> rooms;
  for (const std::string& file : house.files) rooms.insert(room_of(file));
  for (const std::string& room : rooms) {
    if (!table.contains(room)) lines.push_back(room + ": has no row in docs/architecture.md");
  }
  for (const Arrow& arrow : house.arrows) {
    if (is_allowed(table, room_of(arrow.from), arrow.to)) continue;
    lines.push_back(place(arrow) + ", and " + room_of(arrow.from) + " may not include " +
                    room_of(arrow.to));
  }
  return lines;
}

std::vector<std::string> circles(const House& house) {
  std::map<std::string, std::set<std::string>> next;
  for (const Arrow& arrow : house.arrows) {
    if (module_of(arrow.from) != module_of(arrow.to)) {
      next[module_of(arrow.from)].insert(module_of(arrow.to));
    }
  }
  const auto reaches = [&](const std::string& from, const std::string& wanted) {
    std::set<std::string> seen;
    std::function<bool(const std::string&)> search = [&](const std::string& at) {
      if (at == wanted) return true;
      if (!seen.insert(at).second) return false;
      const auto found = next.find(at);
      return found != next.end() && std::any_of(found->second.begin(), found->second.end(), search);
    };
    return search(from);
  };
  std::vector<std::string> lines;
  for (const Arrow& arrow : house.arrows) {
    if (module_of(arrow.from) == module_of(arrow.to)) continue;
    if (reaches(module_of(arrow.to), module_of(arrow.from))) {
      lines.push_back(place(arrow) + ", which includes it in turn");
    }
  }
  return lines;
}

std::vector<std::string> crowded(const House& house, std::size_t most) {
  std::map<std::string, std::set<std::string>> modules;
  for (const std::string& file : house.files) modules[room_of(file)].insert(module_of(file));
  std::vector<std::string> lines;
  for (const auto& [room, inside] : modules) {
    if (inside.size() <= most) continue;
    lines.push_back(room + ": holds " + std::to_string(inside.size()) + " modules, more than " +
                    std::to_string(most));
  }
  return lines;
}

}  // namespace touchdown::tests
