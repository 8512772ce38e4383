#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace touchdown::refusals {

struct Reader {
  /// Reads a file as a user's request does, through a public function. Errors: `InputError`.
  std::function<void(const std::filesystem::path& file)> read;
  bool names_columns = false;  ///< each complaint begins with FILE:LINE:COLUMN
};

/// What a table may name: readers, and texts that are made rather than written.
struct Names {
  std::map<std::string, Reader> readers;
  std::map<std::string, std::function<std::string()>> texts;
};

/// A row of a table that does not hold.
struct Failure {
  int line;  ///< of the row in its table
  std::string words;
};

/// The rows that do not hold of a table of refusals: inputs, the places of the complaints about
/// them, and their words. Errors: `std::runtime_error` for a table that is none.
///
/// A table has a default `reader` and `groups`. A group has the `files` of a folder, and rows that
/// each change the first of them. `given` is the file that is read, the changed one unless stated.
/// A file is a text, or `{source: FILE}` of the project, or
/// `{made: NAME}`, both with `edits` {FROM: TO}. `<folder>` and `<source>` stand for the folder and
/// the project's. A row is a mapping:
///
///   from, to   every FROM in the file becomes TO, in which $& stands for FROM
///   add        a text behind the end of the file
///   text       the whole file
///   edits      {FROM: TO} of the file before all that
///   at         the beginning of the complaint: LINE or LINE:COLUMN of the changed file, or a text;
///              the name of the changed file unless stated
///   says       the words that it has, one text or several
///   lacks      words that it has not
///
/// Several texts under `to`, `add` or `text` are as many inputs. What a group has of `from` and
/// `at` holds for its rows that have none. A complaint is one line. Rows under `taken` are not
/// refused.
std::vector<Failure> failures_of(const YAML::Node& table, const Names& names);

}  // namespace touchdown::refusals
