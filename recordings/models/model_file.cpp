#include "recordings/models/model_file.hpp"

namespace touchdown::recordings {

void write_model(NpzArrays arrays, const std::filesystem::path& path,
                 const std::optional<ModelPassport>& passport) {
  if (passport) add_passport(arrays, *passport);
  write_npz(arrays, path);
}

}  // namespace touchdown::recordings
