// Tests load this library into the real program before all others (LD_PRELOAD). It makes the calls
// that its `Plan` names fail.
//
// A wrapper of write() would miss the calls that the C library itself makes for fclose() or
// fwrite(). So a seccomp filter turns every system call of interest into a signal. The signal
// handler makes the call, or returns an error. It makes calls from one instruction at an address
// that is the same in every process, the only address that the filter lets through. Child programs
// inherit the filter and load this library again. Memory is refused in malloc and related
// functions, from main() on: a program cannot report allocation failures of libraries before
// main().

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <ucontext.h>
#include <unistd.h>

#include "tests/fault_preload/plan.hpp"

/// The C library's sigaction(), without the wrappers of sanitizers.
extern "C" int __sigaction(int signal, const struct sigaction* action,  // NOLINT: its name
                           struct sigaction* before);

namespace touchdown::faults {
namespace {

// A signal handler and malloc can access globals only.
Plan* plan = nullptr;
int (*program)(int count, char** arguments, char** environment) = nullptr;
std::atomic<bool> has_begun{false};

using Call = long (*)(long number, long a, long b, long c, long d, long e, long f);
constexpr std::uintptr_t call_address = 0x6f0000000000;
/// The C library's syscall() without errno: shifts the arguments by one, then `syscall`, `ret`.
constexpr std::array<std::uint8_t, 26> call_code = {
    0x48, 0x89, 0xf8, 0x48, 0x89, 0xf7, 0x48, 0x89, 0xd6, 0x48, 0x89, 0xca, 0x4d,
    0x89, 0xc2, 0x4d, 0x89, 0xc8, 0x4c, 0x8b, 0x4c, 0x24, 0x08, 0x0f, 0x05, 0xc3};
constexpr std::uintptr_t after_call = call_address + call_code.size() - 1;

long call(long number, long a = 0, long b = 0, long c = 0, long d = 0, long e = 0, long f = 0) {
  return reinterpret_cast<Call>(call_address)(number, a, b, c, d, e, f);  // NOLINT
}

[[noreturn]] void give_up(const char* why) {
  ::write(STDERR_FILENO, why, std::strlen(why));
  ::_exit(99);
}

struct Trapped {
  int number;
  Kind kind;
  int path;        ///< index of the path argument; -1: the first argument is a descriptor
  int flags = -1;  ///< index of the flags argument of an open
};
constexpr std::array trapped = {
    Trapped{SYS_read, Kind::read, -1},       Trapped{SYS_pread64, Kind::read, -1},
    Trapped{SYS_readv, Kind::read, -1},      Trapped{SYS_write, Kind::write, -1},
    Trapped{SYS_pwrite64, Kind::write, -1},  Trapped{SYS_writev, Kind::write, -1},
    Trapped{SYS_pwritev, Kind::write, -1},   Trapped{SYS_copy_file_range, Kind::write, -1},
    Trapped{SYS_sendfile, Kind::write, -1},  Trapped{SYS_open, Kind::open, 0, 1},
    Trapped{SYS_openat, Kind::open, 1, 2},   Trapped{SYS_creat, Kind::open, 0},
    Trapped{SYS_rename, Kind::rename, 1},    Trapped{SYS_renameat, Kind::rename, 3},
    Trapped{SYS_renameat2, Kind::rename, 3}, Trapped{SYS_fsync, Kind::flush, -1},
    Trapped{SYS_fdatasync, Kind::flush, -1}, Trapped{SYS_mkdir, Kind::folder, 0},
    Trapped{SYS_mkdirat, Kind::folder, 1},   Trapped{SYS_link, Kind::link, 1},
    Trapped{SYS_linkat, Kind::link, 3},      Trapped{SYS_symlink, Kind::link, 1},
    Trapped{SYS_symlinkat, Kind::link, 2},   Trapped{SYS_ftruncate, Kind::resize, -1},
    Trapped{SYS_truncate, Kind::resize, 0},  Trapped{SYS_fallocate, Kind::resize, -1}};

/// The path of a call, truncated to the array.
std::array<char, 512> path_of(const Trapped& which, const greg_t* registers) {
  static constexpr std::array<int, 4> arguments = {REG_RDI, REG_RSI, REG_RDX, REG_R10};
  std::array<char, 512> path{};
  if (which.path >= 0) {
    const auto* text = reinterpret_cast<const char*>(
        registers[arguments.at(static_cast<std::size_t>(which.path))]);  // NOLINT
    if (text != nullptr) std::strncpy(path.data(), text, path.size() - 1);
    return path;
  }
  // copy_file_range and sendfile write to different descriptors.
  const bool second = which.number == SYS_copy_file_range;
  long descriptor = registers[second ? REG_RDX : REG_RDI];
  std::array<char, 32> link = {"/proc/self/fd/"};
  std::array<char, 12> digits{};
  std::size_t count = 0;
  do {
    digits.at(count++) = static_cast<char>('0' + descriptor % 10);
    descriptor /= 10;
  } while (descriptor > 0 && count < digits.size());
  std::reverse_copy(digits.begin(), digits.begin() + count,
                    link.begin() + std::strlen(link.data()));
  call(SYS_readlink, reinterpret_cast<long>(link.data()), reinterpret_cast<long>(path.data()),
       path.size() - 1);
  return path;
}

/// Whether a call is counted: its path is below the plan's root, or relative and so below it too.
/// Calls on standard error are not.
bool is_counted(const Trapped& which, const greg_t* registers, const char* path) {
  if (which.path < 0 && registers[REG_RDI] == STDERR_FILENO) return false;
  const bool is_relative = which.path >= 0 && path[0] != '/';
  return (is_relative ||
          std::strncmp(path, plan->root.data(), std::strlen(plan->root.data())) == 0) &&
         std::strstr(path, plan->only.data()) != nullptr;
}

void record_refusal(Kind kind, const char* path) {
  const std::uint64_t number = plan->refused.fetch_add(1);
  if (number >= plan->first.size()) return;
  Plan::Refused& refused = plan->first.at(number);
  refused.what = kind;
  std::memcpy(refused.path.data(), path, ::strnlen(path, refused.path.size() - 1));
}

/// Counts a call, and returns whether it fails. Does not return if the program is killed.
bool should_fail(Kind kind, const char* path) {
  if ((plan->counted >> static_cast<unsigned>(kind) & 1U) == 0) return false;
  plan->of_kind.at(static_cast<std::size_t>(kind)).fetch_add(1);
  const std::uint64_t number = plan->seen.fetch_add(1) + 1;
  if (plan->nth == 0 || number < plan->nth || (number > plan->nth && !plan->from_then_on)) {
    return false;
  }
  record_refusal(kind, path);
  if (plan->kills) {
    call(SYS_kill, plan->program, SIGKILL);
    for (;;) call(SYS_pause);
  }
  return true;
}

/// How many of `size` bytes still fit on the disk. Standard output is not on it.
std::int64_t space_for(std::int64_t size, long descriptor) {
  if (descriptor == STDOUT_FILENO) return size;
  const std::int64_t before = plan->written.fetch_add(size);
  if (plan->disk < 0) return size;
  return std::clamp<std::int64_t>(plan->disk - before, 0, size);
}

/// Writes the first bytes of several buffers, as many as fit.
long write_buffers(greg_t* registers, const char* path) {
  const auto* given = reinterpret_cast<const iovec*>(registers[REG_RSI]);  // NOLINT
  std::array<iovec, 16> buffers{};
  const std::size_t count = std::min(static_cast<std::size_t>(registers[REG_RDX]), buffers.size());
  std::int64_t size = 0;
  for (std::size_t i = 0; i < count; ++i) size += static_cast<std::int64_t>(given[i].iov_len);
  std::int64_t left = space_for(size, registers[REG_RDI]);
  if (left == 0 && size > 0) {
    record_refusal(Kind::write, path);
    return -ENOSPC;
  }
  for (std::size_t i = 0; i < count; ++i) {
    buffers.at(i) = {given[i].iov_base, std::min(given[i].iov_len, static_cast<std::size_t>(left))};
    left -= static_cast<std::int64_t>(buffers.at(i).iov_len);
  }
  return call(registers[REG_RAX], registers[REG_RDI], reinterpret_cast<long>(buffers.data()),
              static_cast<long>(count), registers[REG_R10], registers[REG_R8]);
}

/// Writes as many bytes as fit; makes other calls unchanged.
long write_within_capacity(greg_t* registers, const char* path) {
  const long number = registers[REG_RAX];
  if (number == SYS_writev || number == SYS_pwritev) return write_buffers(registers, path);
  if (number == SYS_write || number == SYS_pwrite64) {
    const long size = registers[REG_RDX];
    registers[REG_RDX] = space_for(size, registers[REG_RDI]);
    if (registers[REG_RDX] == 0 && size > 0) {
      record_refusal(Kind::write, path);
      return -ENOSPC;
    }
  }
  return call(number, registers[REG_RDI], registers[REG_RSI], registers[REG_RDX],
              registers[REG_R10], registers[REG_R8], registers[REG_R9]);
}

/// Signal handler of trapped calls: makes the call or fails it.
void handle_call(int /*signal*/, siginfo_t* info, void* context) {
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;  // NOLINT
  registers[REG_RAX] = info->si_syscall;
  const auto* const which = std::find_if(trapped.begin(), trapped.end(), [&](const Trapped& one) {
    return one.number == info->si_syscall;
  });
  const std::array<char, 512> path = path_of(*which, registers);
  long result = 0;
  if (!is_counted(*which, registers, path.data())) {
    result = call(registers[REG_RAX], registers[REG_RDI], registers[REG_RSI], registers[REG_RDX],
                  registers[REG_R10], registers[REG_R8], registers[REG_R9]);
  } else if (should_fail(which->kind, path.data())) {
    result = -plan->error;
  } else {
    result = write_within_capacity(registers, path.data());
  }
  registers[REG_RAX] = result;
}

/// Installs a permanent filter that traps the listed calls unless they come from `call_address`.
void install_filter() {
  std::array<sock_filter, 8 + 5 * trapped.size()> code{};
  std::size_t size = 0;
  const auto add = [&](sock_filter one) { code.at(size++) = one; };
  const auto load = [&](std::size_t offset) {
    add(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
  };
  load(offsetof(seccomp_data, instruction_pointer) + 4);
  add(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(after_call >> 32U), 0, 3));
  load(offsetof(seccomp_data, instruction_pointer));
  add(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(after_call), 0, 1));
  add(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  load(offsetof(seccomp_data, nr));
  for (const Trapped& one : trapped) {
    // A child program reads its libraries before it loads this one.
    if (one.kind == Kind::read && (plan->counted & 1U << static_cast<unsigned>(Kind::read)) == 0) {
      continue;
    }
    const bool has_flags = one.flags >= 0;
    const std::uint8_t to_next = has_flags ? 4 : 1;
    add(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(one.number), 0, to_next));
    if (has_flags) {  // opened for writing?
      load(offsetof(seccomp_data, args) + 8 * static_cast<std::size_t>(one.flags));
      add(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, O_WRONLY | O_RDWR | O_CREAT, 1, 0));
      add(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    }
    add(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP));
  }
  add(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog filter{static_cast<unsigned short>(size), code.data()};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0) {
    give_up("faults: this system has no seccomp filters\n");
  }
}

/// The value of an environment variable, or null. The C library may not be initialised yet.
const char* value_of(const char* variable, char** environment) {
  const std::size_t length = std::strlen(variable);
  for (char** entry = environment; *entry != nullptr; ++entry) {
    if (std::strncmp(*entry, variable, length) == 0 && (*entry)[length] == '=') {
      return *entry + length + 1;
    }
  }
  return nullptr;
}

/// Runs before the constructors of other libraries (-z initfirst), which may make trapped calls.
__attribute__((constructor)) void begin(int /*count*/, char** /*arguments*/, char** environment) {
  const char* const file = value_of(plan_variable, environment);
  if (file == nullptr) return;
  void* const code =
      ::mmap(reinterpret_cast<void*>(call_address), call_code.size(),  // NOLINT
             PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
  if (code == MAP_FAILED) give_up("faults: the address is taken\n");
  std::memcpy(code, call_code.data(), call_code.size());
  ::mprotect(code, call_code.size(), PROT_READ | PROT_EXEC);
  struct sigaction action = {};
  action.sa_sigaction = handle_call;
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_NODEFER);
  ::__sigaction(SIGSYS, &action, nullptr);
  // From here on, calls may be trapped: a program that inherits the filter already traps this one.
  const long descriptor =
      call(SYS_openat, AT_FDCWD, reinterpret_cast<long>(file), O_RDWR | O_CLOEXEC);
  void* const shared = descriptor < 0 ? MAP_FAILED
                                      : ::mmap(nullptr, sizeof(Plan), PROT_READ | PROT_WRITE,
                                               MAP_SHARED, static_cast<int>(descriptor), 0);
  if (shared == MAP_FAILED) give_up("faults: there is no plan\n");
  ::close(static_cast<int>(descriptor));
  plan = static_cast<Plan*>(shared);
  if (plan->has_filter.exchange(true)) return;
  plan->program = ::getpid();
  install_filter();
}

/// Calls the program's main().
int counted_main(int count, char** arguments, char** environment) {
  has_begun = true;
  return program(count, arguments, environment);
}

[[maybe_unused]] bool is_refused(std::size_t size) {
  return has_begun && plan != nullptr && size >= plan->smallest_allocation &&
         should_fail(Kind::allocation, "memory");
}

}  // namespace
}  // namespace touchdown::faults

/// Replaces the C library's function, which calls main() in every program.
extern "C" int __libc_start_main(decltype(touchdown::faults::program) main,  // NOLINT: its name
                                 int count, char** arguments, void (*begin)(), void (*end)(),
                                 void (*unload)(), void* stack) {
  touchdown::faults::program = main;
  const auto start = reinterpret_cast<decltype(&__libc_start_main)>(
      ::dlsym(RTLD_NEXT, "__libc_start_main"));  // NOLINT
  return start(touchdown::faults::counted_main, count, arguments, begin, end, unload, stack);
}

#ifndef TOUCHDOWN_LEAVES_MEMORY

// The C library's own functions, under the names that it exports for replacements.
// NOLINTBEGIN(readability-identifier-naming): its names
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
// NOLINTEND(readability-identifier-naming)

void* malloc(std::size_t size) {
  if (!touchdown::faults::is_refused(size)) return __libc_malloc(size);
  errno = ENOMEM;
  return nullptr;
}

void* calloc(std::size_t count, std::size_t size) {
  if (!touchdown::faults::is_refused(count * size)) return __libc_calloc(count, size);
  errno = ENOMEM;
  return nullptr;
}

void* realloc(void* memory, std::size_t size) {
  if (!touchdown::faults::is_refused(size)) return __libc_realloc(memory, size);
  errno = ENOMEM;
  return nullptr;
}

void* memalign(std::size_t alignment, std::size_t size) {
  if (!touchdown::faults::is_refused(size)) return __libc_memalign(alignment, size);
  errno = ENOMEM;
  return nullptr;
}

void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}

#endif
