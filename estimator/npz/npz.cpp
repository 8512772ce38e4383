#include "estimator/npz/npz.hpp"

#include <cerrno>
#include <cstring>
#include <memory>
#include <new>
#include <system_error>
#include <zip.h>

namespace touchdown {

namespace {

/// Far more than the arrays of a model or a log have.
constexpr std::size_t most_bytes = std::size_t{1} << 30U;
constexpr std::string_view extension = ".npy";

struct DiscardZip {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Zip = std::unique_ptr<zip_t, DiscardZip>;

struct CloseMember {
  void operator()(zip_file_t* member) const { zip_fclose(member); }
};
using Member = std::unique_ptr<zip_file_t, CloseMember>;

Zip open_zip(const std::filesystem::path& path, int flags) {
  int code = 0;
  errno = 0;
  Zip archive(zip_open(path.c_str(), flags, &code));
  if (archive) return archive;
  if (code == ZIP_ER_MEMORY) throw std::bad_alloc();
  if (code == ZIP_ER_OPEN && (errno == EMFILE || errno == ENFILE)) {
    throw Error(path.string() + ": cannot be opened: " + std::strerror(errno));
  }
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  throw InputError(path.string() + ": is not a readable .npz file: " + reason);
}

/// Takes the array's bytes from those that are `left` to read.
ModelArray read_member(zip_t& archive, zip_uint64_t index, const std::string& where, NpyPart part,
                       std::size_t& left) {
  zip_stat_t status;
  if (zip_stat_index(&archive, index, 0, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0 ||
      status.size > left) {
    throw InputError(where + ": has no sensible size");
  }
  const Member member(zip_fopen_index(&archive, index, 0));
  if (!member) throw InputError(where + ": " + zip_strerror(&archive));
  std::string bytes(status.size, '\0');
  char beyond = 0;
  const zip_int64_t size = zip_fread(member.get(), bytes.data(), bytes.size());
  // libzip compares the checksum where it meets the end of the member.
  if (size < 0 || zip_fread(member.get(), &beyond, 1) != 0) {
    throw InputError(where + ": " + zip_file_strerror(member.get()));
  }
  bytes.resize(static_cast<std::size_t>(size));
  left -= bytes.size();
  return from_npy(bytes, where, part);
}

/// Calls `visit(index, name)` for every array of the file.
template <typename Visit>
void for_each_array(zip_t& archive, const std::filesystem::path& path, const Visit& visit) {
  bool has_arrays = false;
  const zip_int64_t count = zip_get_num_entries(&archive, 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    const char* raw_name = zip_get_name(&archive, index, 0);
    std::string name = raw_name == nullptr ? "" : raw_name;
    if (!name.ends_with(extension)) continue;
    name.resize(name.size() - extension.size());
    has_arrays = true;
    visit(index, name);
  }
  if (!has_arrays) throw InputError(path.string() + ": holds no arrays");
}

Zip open_npz(const std::filesystem::path& path) {
  using Type = std::filesystem::file_type;
  std::error_code error;
  const Type type = std::filesystem::status(path, error).type();
  if (type == Type::directory) throw InputError(path.string() + ": is a folder");
  if (type == Type::not_found) throw InputError(path.string() + ": no such file");
  if (type == Type::none) {  // a folder without permission, a loop of links, too long a name
    throw InputError(path.string() + ": cannot be opened: " + error.message());
  }
  if (type != Type::regular) throw InputError(path.string() + ": is not a regular file");
  return open_zip(path, ZIP_RDONLY | ZIP_CHECKCONS);
}

struct FreeSource {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using Source = std::unique_ptr<zip_source_t, FreeSource>;

/// The bytes of an archive that was written to a source.
std::string content_of(zip_source_t& source) {
  zip_stat_t status;
  if (zip_source_stat(&source, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0 ||
      zip_source_open(&source) != 0) {
    throw std::bad_alloc();
  }
  std::string content(status.size, '\0');
  const zip_int64_t size = zip_source_read(&source, content.data(), content.size());
  zip_source_close(&source);
  if (size != static_cast<zip_int64_t>(content.size())) throw std::bad_alloc();
  return content;
}

[[noreturn]] void complain(zip_t& archive, const std::string& where, const char* what) {
  if (zip_error_code_zip(zip_get_error(&archive)) == ZIP_ER_MEMORY) throw std::bad_alloc();
  throw Error(where + ": " + what + ": " + zip_strerror(&archive));
}

void add_member(zip_t& archive, const std::string& name, const std::string& bytes,
                Deflated deflated) {
  zip_source_t* source = zip_source_buffer(&archive, bytes.data(), bytes.size(), 0);
  const zip_int64_t added =
      source == nullptr ? -1 : zip_file_add(&archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (added < 0) {
    zip_source_free(source);
    complain(archive, name, "cannot be added");
  }
  const auto index = static_cast<zip_uint64_t>(added);
  // A fixed date: the same arrays must give the same bytes.
  constexpr zip_uint16_t midnight = 0;
  constexpr zip_uint16_t first_of_january_1980 = (1U << 5U) | 1U;
  // Large grids take a third of their size deflated, at any level.
  const bool is_deflated = deflated == Deflated::all || bytes.size() > 400'000;
  if (zip_set_file_compression(&archive, index, is_deflated ? ZIP_CM_DEFLATE : ZIP_CM_STORE,
                               is_deflated ? 1 : 0) != 0 ||
      zip_file_set_dostime(&archive, index, midnight, first_of_january_1980, 0) != 0) {
    complain(archive, name, "cannot be added");
  }
}

}  // namespace

ModelArrays read_npz(const std::filesystem::path& path, const NpzNeeds& needs, NpyPart part) {
  const Zip archive = open_npz(path);
  ModelArrays arrays;
  std::size_t left = most_bytes;
  for_each_array(*archive, path, [&](zip_uint64_t index, const std::string& name) {
    if (needs && !needs(name)) return;
    arrays[name] = read_member(*archive, index, path.string() + ": " + name, part, left);
  });
  return arrays;
}

std::vector<std::string> npz_names(const std::filesystem::path& path) {
  std::vector<std::string> names;
  for_each_array(*open_npz(path), path,
                 [&](zip_uint64_t /*index*/, const std::string& name) { names.push_back(name); });
  return names;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): the loop empties the arrays
std::string to_npz(ModelArrays arrays, const std::string& name, Deflated deflated) {
  // In memory: otherwise libzip would make a temporary file of unknown name, which could be left
  // behind.
  const Source memory(zip_source_buffer_create(nullptr, 0, 0, nullptr));
  if (!memory) throw std::bad_alloc();
  std::vector<std::string> contents;  // libzip reads them when the archive is closed
  contents.reserve(arrays.size());
  Zip archive(zip_open_from_source(memory.get(), ZIP_CREATE | ZIP_TRUNCATE, nullptr));
  if (!archive) throw std::bad_alloc();
  zip_source_keep(memory.get());  // closing the archive releases its own reference
  for (auto& [member, array] : arrays) {
    contents.push_back(to_npy(array));
    array = {};  // large models are in memory once
    add_member(*archive, member + std::string(extension), contents.back(), deflated);
  }
  if (zip_close(archive.get()) != 0) complain(*archive, name, "cannot be written");
  static_cast<void>(archive.release());
  return content_of(*memory);
}

}  // namespace touchdown
