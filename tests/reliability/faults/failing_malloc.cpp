// Preloaded into the program: some allocations of the process fail.
//
// SIMDBEZIER_FAIL_FROM, SIMDBEZIER_FAIL_TO: numbers of the first and the last that fails, 1 being
// the first that main() makes.
// SIMDBEZIER_ALLOCATIONS: a file that gets the number of all when the program ends.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

// glibc's own names, so that nothing needs to be looked up, which would allocate.
extern "C" {
void* __libc_malloc(std::size_t size);                          // NOLINT: as it is called there
void* __libc_calloc(std::size_t count, std::size_t size);       // NOLINT
void* __libc_realloc(void* memory, std::size_t size);           // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size); // NOLINT
}

namespace {

constinit std::atomic<long> allocations{0};
constinit long first_refused = -1;
constinit long last_refused = -1;

long number_in(const char* name) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::strtol(text, nullptr, 10) : -1;
}

using Main = int (*)(int, char**, char**);
constinit Main program_main = nullptr;

int counted_main(int argc, char** argv, char** environment) {
  first_refused = number_in("SIMDBEZIER_FAIL_FROM");
  last_refused = number_in("SIMDBEZIER_FAIL_TO");
  allocations = 0;
  return program_main(argc, argv, environment);
}

// Writes the digits by hand, because formatting could allocate.
__attribute__((destructor)) void end() {
  const char* const path = std::getenv("SIMDBEZIER_ALLOCATIONS");
  const int file = path != nullptr ? open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600) : -1;
  if (file < 0) {
    return;
  }
  char digits[24];
  std::size_t used = sizeof digits;
  for (long left = allocations; left > 0; left /= 10) {
    digits[--used] = static_cast<char>('0' + left % 10);
  }
  if (write(file, digits + used, sizeof digits - used) < 0) {
    std::abort();
  }
  close(file);
}

bool refused() {
  const long number = ++allocations;
  if (number < first_refused || number > last_refused) {
    return false;
  }
  errno = ENOMEM;
  return true;
}

} // namespace

#define SIMDBEZIER_EXPORT __attribute__((visibility("default")))
extern "C" {
// Called by the program's first instructions. What libraries allocate for themselves before main()
// nobody could catch.
SIMDBEZIER_EXPORT int __libc_start_main(Main main, int argc, char** argv, // NOLINT
                                        void (*init)(), void (*fini)(), void (*unload)(),
                                        void* stack) {
  program_main = main;
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main")); // NOLINT
  return start(counted_main, argc, argv, init, fini, unload, stack);
}
SIMDBEZIER_EXPORT void* malloc(std::size_t size) noexcept {
  return refused() ? nullptr : __libc_malloc(size);
}
SIMDBEZIER_EXPORT void* calloc(std::size_t count, std::size_t size) noexcept {
  return refused() ? nullptr : __libc_calloc(count, size);
}
SIMDBEZIER_EXPORT void* realloc(void* memory, std::size_t size) noexcept {
  return refused() ? nullptr : __libc_realloc(memory, size);
}
SIMDBEZIER_EXPORT void* memalign(std::size_t alignment, std::size_t size) noexcept {
  return refused() ? nullptr : __libc_memalign(alignment, size);
}
SIMDBEZIER_EXPORT void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return refused() ? nullptr : __libc_memalign(alignment, size);
}
SIMDBEZIER_EXPORT int posix_memalign(void** memory, std::size_t alignment,
                                     std::size_t size) noexcept {
  void* const found = refused() ? nullptr : __libc_memalign(alignment, size);
  if (found == nullptr) {
    return ENOMEM;
  }
  *memory = found;
  return 0;
}
}
