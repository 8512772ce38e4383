#pragma once

#include <string>
#include <vector>

#include "core/key.hpp"

namespace touchdown::cli {

/// A kind of YAML file, with all of its keys.
struct FileKind {
  std::string name;   ///< on the command line
  std::string title;  ///< in headings
  std::string usage;  ///< what the file is for, and an example, in one sentence
  std::vector<Key> (*keys)();
};

/// All kinds, in the order of the reference.
const std::vector<FileKind>& file_kinds();

/// The kind of this name. Errors: `InputError` with the nearest name.
const FileKind& file_kind(const std::string& name);

}  // namespace touchdown::cli
