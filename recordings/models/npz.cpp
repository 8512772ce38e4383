#include "recordings/models/npz.hpp"

#include <memory>
#include <zip.h>

#include <fmt/ranges.h>

#include "core/files.hpp"

namespace touchdown::recordings {

namespace {

constexpr zip_uint64_t largest_member = zip_uint64_t{1} << 31U;
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
  Zip archive(zip_open(path.c_str(), flags, &code));
  if (archive) return archive;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  throw InputError(fmt::format("{}: is not a readable .npz file: {}", path.string(), reason));
}

std::string read_member(zip_t& archive, zip_uint64_t index, const std::string& where) {
  zip_stat_t status;
  if (zip_stat_index(&archive, index, 0, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0 ||
      status.size > largest_member) {
    throw InputError(fmt::format("{}: has no sensible size", where));
  }
  const Member member(zip_fopen_index(&archive, index, 0));
  if (!member) throw InputError(fmt::format("{}: {}", where, zip_strerror(&archive)));
  std::string bytes;
  std::vector<char> buffer(std::size_t{1} << 16U);
  while (true) {
    // At the end of a member libzip compares the checksum.
    const zip_int64_t size = zip_fread(member.get(), buffer.data(), buffer.size());
    if (size < 0) throw InputError(fmt::format("{}: {}", where, zip_file_strerror(member.get())));
    if (size == 0) break;
    bytes.append(buffer.data(), static_cast<std::size_t>(size));
  }
  if (bytes.size() != status.size) throw InputError(fmt::format("{}: is cut off", where));
  return bytes;
}

void add_member(zip_t& archive, const std::string& name, const std::string& bytes) {
  zip_source_t* source = zip_source_buffer(&archive, bytes.data(), bytes.size(), 0);
  const zip_int64_t added =
      source == nullptr ? -1 : zip_file_add(&archive, name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (added < 0) {
    zip_source_free(source);
    throw Error(fmt::format("{}: cannot be added: {}", name, zip_strerror(&archive)));
  }
  const auto index = static_cast<zip_uint64_t>(added);
  // Neither compression nor the clock: the same arrays must give the same bytes.
  constexpr zip_uint16_t midnight = 0;
  constexpr zip_uint16_t first_of_january_1980 = (1U << 5U) | 1U;
  if (zip_set_file_compression(&archive, index, ZIP_CM_STORE, 0) != 0 ||
      zip_file_set_dostime(&archive, index, midnight, first_of_january_1980, 0) != 0) {
    throw Error(fmt::format("{}: cannot be added: {}", name, zip_strerror(&archive)));
  }
}

}  // namespace

NpzArrays read_npz(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw InputError(fmt::format("{}: no such file", path.string()));
  }
  const Zip archive = open_zip(path, ZIP_RDONLY | ZIP_CHECKCONS);
  NpzArrays arrays;
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    const char* raw_name = zip_get_name(archive.get(), index, 0);
    std::string name = raw_name == nullptr ? "" : raw_name;
    if (!name.ends_with(extension)) continue;
    name.resize(name.size() - extension.size());
    const std::string where = fmt::format("{}: {}", path.string(), name);
    arrays[name] = from_npy(read_member(*archive, index, where), where);
  }
  if (arrays.empty()) throw InputError(fmt::format("{}: holds no arrays", path.string()));
  return arrays;
}

void require_arrays(const NpzArrays& arrays, std::string_view what,
                    std::vector<std::string> names) {
  std::erase_if(names, [&](const std::string& name) { return arrays.contains(name); });
  if (names.empty()) return;
  throw InputError(fmt::format("is no {}: missing {}", what, fmt::join(names, ", ")));
}

void write_npz(const NpzArrays& arrays, const std::filesystem::path& path) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::vector<std::string> contents;  // libzip reads them when the archive is closed
    contents.reserve(arrays.size());
    Zip archive = open_zip(temporary, ZIP_CREATE | ZIP_TRUNCATE);
    for (const auto& [name, array] : arrays) {
      contents.push_back(to_npy(array));
      add_member(*archive, name + std::string(extension), contents.back());
    }
    if (zip_close(archive.get()) != 0) {
      throw Error(
          fmt::format("{}: cannot be written: {}", path.string(), zip_strerror(archive.get())));
    }
    static_cast<void>(archive.release());
  });
}

}  // namespace touchdown::recordings
