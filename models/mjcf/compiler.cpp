#include "models/mjcf/compiler.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <new>
#include <regex>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::models {

namespace {

/// Whether an error message of MuJoCo is about memory.
bool is_about_memory(std::string_view message) {
  return message.find("ould not allocate") != std::string_view::npos;
}

/// Replaces MuJoCo's own handlers, which wait for a key press or write MUJOCO_LOG.TXT into the
/// working directory.
void install_mujoco_handlers() {
  static std::once_flag once;
  std::call_once(once, [] {
    mju_user_error = [](const char* message) {
      if (is_about_memory(message)) throw std::bad_alloc();
      throw Error(std::string("MuJoCo: ") + message);
    };
    mju_user_warning = [](const char*) {};  // a simulator reports divergence as an outcome
  });
}

/// MuJoCo saves the model that it read last, in whichever thread.
std::mutex& last_model() {
  static std::mutex mutex;
  return mutex;
}

/// Formats an error message of MuJoCo as one line that begins with a place.
std::string located(const MjcfDocument& document, std::string message) {
  std::smatch match;
  std::string name;
  if (std::regex_search(message, match, std::regex("[Nn]ame = ([^,\\n]+)"))) name = match[1].str();
  const bool is_named = !name.empty();
  if (!is_named && std::regex_search(message, match, std::regex("[Ee]lement '(\\w+)'"))) {
    name = match[1].str();
  }
  int line = 0;
  if (std::regex_search(message, match, std::regex("line[ =]+(\\d{1,8})"))) {
    line = std::stoi(match[1].str());
    message = std::regex_replace(message, std::regex(",? *line[ =]+\\d+(, *column +-?\\d+)?"), "");
  }
  const std::string where = document.place_in(line, name);
  if (is_named) {
    message = std::regex_replace(message, std::regex("^Error: *|\\s*Object name = [\\s\\S]*"), "");
    if (message.find("larger than mjMINVAL") != std::string::npos) {
      message = "expected a mass and an inertia above 0, of an <inertial> or a shape";
    } else if (message.starts_with("repeated name")) {
      message = "expected each name once: " + message;
    }
    message = fmt::format("'{}': {}", name, message);
  }
  if (message.find("Schema violation") != std::string::npos) {
    message +=
        fmt::format(" (this is MuJoCo {}: may it be of a later version?)", mj_versionString());
  }
  std::replace(message.begin(), message.end(), '\n', ' ');
  while (!message.empty() && message.back() == ' ') message.pop_back();
  return where + ": " + message;
}

MjModelPtr load(const MjcfDocument& document, const std::string& more) {
  const std::string text = document.edited(more);
  install_mujoco_handlers();
  // The name is in the folder of the robot's file, so that meshes are found there.
  const char* const file_name = "touchdown_composed.xml";
  const auto release = [](mjVFS* vfs) {
    mj_deleteVFS(vfs);
    delete vfs;
  };
  std::unique_ptr<mjVFS, decltype(release)> vfs(new mjVFS, release);
  mj_defaultVFS(vfs.get());
  if (mj_makeEmptyFileVFS(vfs.get(), file_name, static_cast<int>(text.size())) != 0) {
    throw Error("MuJoCo has no room for the composed model");
  }
  const int slot = mj_findFileVFS(vfs.get(), file_name);
  std::memcpy(vfs->filedata[slot], text.data(), text.size());

  std::array<char, 1000> message = {};
  const std::string beside = (document.file().parent_path() / file_name).string();
  MjModelPtr model(
      mj_loadXML(beside.c_str(), vfs.get(), message.data(), static_cast<int>(message.size())));
  if (!model && is_about_memory(message.data())) throw std::bad_alloc();
  if (!model) throw InputError(located(document, message.data()));
  return model;
}

}  // namespace

MjDataPtr make_data(const mjModel& model) {
  MjDataPtr data(mj_makeData(&model));
  if (!data) throw Error("MuJoCo could not make its data: out of memory");
  return data;
}

MjModelPtr compile_xml(const MjcfDocument& document, const std::string& more) {
  const std::scoped_lock lock(last_model());
  return load(document, more);
}

std::string converted_to_mjcf(const MjcfDocument& urdf) {
  const std::scoped_lock lock(last_model());
  const MjModelPtr model = load(urdf, {});
  // MuJoCo writes to files only.
  std::string folder = (temporary_folder() / "touchdown_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    throw Error(fmt::format("{}: cannot make a temporary folder", folder));
  }
  const std::filesystem::path saved = std::filesystem::path(folder) / "robot.xml";
  std::array<char, 1000> message = {};
  const bool is_saved = mj_saveLastXML(saved.c_str(), model.get(), message.data(),
                                       static_cast<int>(message.size())) != 0;
  std::string text = is_saved ? read_file(saved) : std::string();
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  if (!is_saved) throw Error(fmt::format("{}: MuJoCo: {}", urdf.file().string(), message.data()));
  // MuJoCo does not report what could not be written.
  if (text.find("</mujoco>") == std::string::npos) {
    throw Error(fmt::format("{}: cannot be written in full: is the disk full?", saved.string()));
  }
  return text;
}

}  // namespace touchdown::models
