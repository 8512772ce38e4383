#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace touchdown {

/// Whether a text of a user's file can be part of a file or folder name: one word of at most 100
/// bytes without path characters (`/`, `\`, `.`), blanks or control characters.
bool is_name_word(std::string_view text);

/// The error message for a text that is not such a word.
inline constexpr const char* expected_name_word = "expected a word that can name a folder";

/// Whether the whole name matches a regular expression (ECMAScript).
bool has_shape(const std::string& name, const std::string& shape);

/// A temporary path beside `path` for a file that is renamed to `path` once it is complete. The
/// name is hidden, and contains the process number and random digits, so that no other process uses
/// or guesses it. The extension stays last: encoders and plotters choose their format by it.
std::filesystem::path part_path(const std::filesystem::path& path);
/// The same for a folder.
std::filesystem::path part_folder_path(const std::filesystem::path& path);

/// Whether a name has the form of those that the functions above make.
bool is_part_file_name(const std::filesystem::path& name);
bool is_part_folder_name(const std::filesystem::path& name);

}  // namespace touchdown
