#include "tests/faults/injection.hpp"

#include <fcntl.h>
#include <new>
#include <regex>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

namespace touchdown::faults {

namespace {

std::string name_of(const Plan::Refused& refused) {
  if (refused.what == Kind::allocation) return "memory";
  const std::filesystem::path path = refused.path.data();
  if (path.filename() == ".started.stdout") return "standard output";
  static const std::regex part(R"(\.(.+)\.\d+\.[0-9a-f]{8}\.part(\..+)?)");
  std::smatch match;
  // A partial figure lies in a partial folder.
  for (const std::filesystem::path& name : path) {
    const std::string text = name.string();
    if (std::regex_match(text, match, part)) return match[1].str() + match[2].str();
  }
  return path.filename().string();
}

}  // namespace

Injection::Injection(const std::filesystem::path& root) : file_(root / ".faults") {
  constexpr int mode = 0600;
  const int descriptor = ::open(file_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, mode);
  void* memory = MAP_FAILED;
  if (descriptor >= 0 && ::ftruncate(descriptor, sizeof(Plan)) == 0) {
    memory = ::mmap(nullptr, sizeof(Plan), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  }
  if (memory == MAP_FAILED) throw std::system_error(errno, std::generic_category(), file_.string());
  ::close(descriptor);
  plan_ = new (memory) Plan;
  std::filesystem::canonical(root).string().copy(plan_->root.data(), plan_->root.size() - 1);
}

Injection::~Injection() { ::munmap(plan_, sizeof(Plan)); }

std::vector<std::string> Injection::environment() const {
  // ASan would require to be loaded first.
  return {"LD_PRELOAD=" TOUCHDOWN_FAULT_PRELOAD, std::string(plan_variable) + "=" + file_.string(),
          "ASAN_OPTIONS=verify_asan_link_order=0:detect_leaks=0"};
}

std::vector<std::string> Injection::subjects() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < plan_->first.size() && i < plan_->refused; ++i) {
    names.push_back(name_of(plan_->first.at(i)));
  }
  return names;
}

bool Injection::has_refused(Kind kind) const {
  return plan_->refused > 0 && plan_->first.front().what == kind;
}

}  // namespace touchdown::faults
