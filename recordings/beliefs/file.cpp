#include "recordings/beliefs/file.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "recordings/beliefs/csv.hpp"
#include "recordings/beliefs/mpack.hpp"
#include "recordings/beliefs/npz.hpp"

namespace touchdown::recordings {

Beliefs read_beliefs(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  if (extension == ".csv") return read_belief_csv(path);
  if (extension == ".npz") return read_belief_npz(path);
  if (extension == ".mpack") return read_belief_mpack(path);
  throw InputError(fmt::format("{}: expected the extension .csv, .npz or .mpack", path.string()));
}

}  // namespace touchdown::recordings
