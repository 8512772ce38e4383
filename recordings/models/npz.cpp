#include "recordings/models/npz.hpp"

#include <memory>
#include <new>
#include <utility>
#include <zip.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::recordings {

namespace {

constexpr std::string_view extension = ".npy";

struct DiscardZip {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Zip = std::unique_ptr<zip_t, DiscardZip>;

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
  throw Error(fmt::format("{}: {}: {}", where, what, zip_strerror(&archive)));
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
  // The grids of a phase model take 40 MB, and a third of that deflated, at any level.
  const bool is_deflated = deflated == Deflated::all || bytes.size() > 400'000;
  if (zip_set_file_compression(&archive, index, is_deflated ? ZIP_CM_DEFLATE : ZIP_CM_STORE,
                               is_deflated ? 1 : 0) != 0 ||
      zip_file_set_dostime(&archive, index, midnight, first_of_january_1980, 0) != 0) {
    complain(archive, name, "cannot be added");
  }
}

}  // namespace

// NOLINTNEXTLINE(performance-unnecessary-value-param): the loop empties the arrays
std::string to_npz(NpzArrays arrays, const std::string& name, Deflated deflated) {
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

void write_npz(NpzArrays arrays, const std::filesystem::path& path) {
  write_atomically(path, to_npz(std::move(arrays), path.string(), Deflated::large));
}

}  // namespace touchdown::recordings
