#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace touchdown {

/// Whether a text that somebody wrote into a file can be part of a file's or a folder's name: one
/// word of at most 100 bytes, without what leads to other folders (`/`, `\`, `.`) and without
/// blanks and control characters.
bool is_name_word(std::string_view text);

/// What who reads such a text complains of.
inline constexpr const char* expected_name_word = "expected a word that can name a folder";

/// Whether a name as a whole is what a regular expression (ECMAScript's) describes.
bool has_shape(const std::string& name, const std::string& shape);

/// A path beside `path` for what becomes `path` when it is whole: hidden, and with this process's
/// number and chance in it, so that nobody else writes there or knows the name before. The
/// extension stays last: encoders and plotters choose their format by it.
std::filesystem::path part_path(const std::filesystem::path& path);
/// Likewise for a folder.
std::filesystem::path part_folder_path(const std::filesystem::path& path);

/// Whether a name is one that these could have made.
bool is_part_file_name(const std::filesystem::path& name);
bool is_part_folder_name(const std::filesystem::path& name);

}  // namespace touchdown
