// Runs before every library of the program has started, because two faults would end it there
// without a word: an instruction that the processor lacks, and OpenBLAS, which OpenCV brings with
// it, when it asks for 128 MiB again and again although the system refuses them. This source alone
// is compiled for every processor, and it uses nothing that a library would have to start first.

#include <cstddef>
#include <sys/mman.h>
#include <unistd.h>

namespace {

template <std::size_t size>
[[noreturn]] void refuse(const char (&message)[size]) {
  (void)!::write(STDERR_FILENO, message, size - 1);
  ::_exit(1);
}

/// What OpenBLAS maps first, and as much again for the threads of the libraries.
constexpr std::size_t bytes_at_start = std::size_t{256} << 20U;

void check_machine(int /*count*/, char** /*words*/, char** /*environment*/) {
#ifdef TOUCHDOWN_NEEDS_AVX2
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") ||
      !__builtin_cpu_supports("bmi2")) {
    refuse(
        "touchdown: this processor has no AVX2, for which the program was compiled: compile it on "
        "this machine, or "
        "with -DTOUCHDOWN_NATIVE=OFF\n");
  }
#endif
  void* const probe =
      ::mmap(nullptr, bytes_at_start, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (probe == MAP_FAILED) {
    refuse("touchdown: there is not enough memory to start: `ulimit -v` must allow 1 GB\n");
  }
  ::munmap(probe, bytes_at_start);
}

}  // namespace

// The loader calls these before it starts the libraries.
[[gnu::used,
  gnu::section(".preinit_array")]] void (*const touchdown_check_machine)(int, char**,
                                                                         char**) = &check_machine;
