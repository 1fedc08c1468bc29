// Answers that the system may give and hardly ever gives. This is loaded in front of the C library:
// the fault that SIMDBEZIER_TEST_FAULT names happens, everything else is as it was.
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

namespace {

bool is_wanted(std::string_view fault) {
  const char* const wanted = std::getenv("SIMDBEZIER_TEST_FAULT");
  return wanted != nullptr && fault == wanted;
}

// The function of that name behind this library.
template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int failed(int error) {
  errno = error;
  return -1;
}

bool is_nameless(int flags) { return (flags & O_TMPFILE) == O_TMPFILE; }

// The mode that a file is opened with, which is there only where one may be created.
mode_t mode_of(int flags, va_list rest) {
  return (flags & O_CREAT) != 0 || is_nameless(flags) ? va_arg(rest, mode_t) : 0;
}

void created() {
  if (is_wanted("termination_at_creation")) {
    raise(SIGTERM);
  }
}

} // namespace

extern "C" {

__attribute__((visibility("default"))) int pthread_create(pthread_t* thread,
                                                          const pthread_attr_t* attributes,
                                                          void* (*start)(void*), void* argument) {
  return is_wanted("thread_refused")
             ? EAGAIN
             : next<int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>(
                   "pthread_create")(thread, attributes, start, argument);
}

__attribute__((visibility("default"))) int fsync(int file) {
  return is_wanted("sync_fails")         ? failed(EIO)
         : is_wanted("sync_unsupported") ? failed(EINVAL)
                                         : next<int(int)>("fsync")(file);
}

__attribute__((visibility("default"))) int fchown(int file, uid_t owner, gid_t group) {
  return is_wanted("owner_refused") ? failed(EPERM)
                                    : next<int(int, uid_t, gid_t)>("fchown")(file, owner, group);
}

__attribute__((visibility("default"))) int renameat(int from, const char* name, int to,
                                                    const char* target) {
  return is_wanted("rename_refused")
             ? failed(EPERM)
             : next<int(int, const char*, int, const char*)>("renameat")(from, name, to, target);
}

// A few bytes at a time, and every other time none because a signal came.
__attribute__((visibility("default"))) ssize_t write(int file, const void* data, size_t size) {
  static bool interrupted = false;
  if (is_wanted("short_writes") && file > STDERR_FILENO) {
    interrupted = !interrupted;
    if (interrupted) {
      return failed(EINTR);
    }
    size = size > 1000 ? 997 : (size + 1) / 2;
  }
  return next<ssize_t(int, const void*, size_t)>("write")(file, data, size);
}

// A disk that has room for nothing, or for little at a time.
__attribute__((visibility("default"))) ssize_t pwrite64(int file, const void* data, size_t size,
                                                        off64_t at) {
  constexpr size_t kMuch = size_t{1} << 16;
  return is_wanted("disk_full") || (size > kMuch && is_wanted("disk_full_for_much"))
             ? failed(ENOSPC)
             : next<ssize_t(int, const void*, size_t, off64_t)>("pwrite64")(file, data, size, at);
}

__attribute__((visibility("default"))) ssize_t pwrite(int file, const void* data, size_t size,
                                                      off_t at) {
  return pwrite64(file, data, size, at);
}

__attribute__((visibility("default"))) int openat(int folder, const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  if ((flags & O_CREAT) != 0 && is_wanted("folder_refuses")) {
    return failed(EACCES);
  }
  const int file = next<int(int, const char*, int, ...)>("openat")(folder, name, flags, mode);
  if ((flags & O_CREAT) != 0 && file >= 0) {
    created();
  }
  return file;
}

// A file system that has no files without names, and a signal as soon as one with a name is there.
__attribute__((visibility("default"))) int open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return is_wanted("termination_at_named_spill") && is_nameless(flags)
             ? failed(EOPNOTSUPP)
             : next<int(const char*, int, ...)>("open")(name, flags, mode);
}

__attribute__((visibility("default"))) int mkostemp(char* name, int flags) {
  const int file = next<int(char*, int)>("mkostemp")(name, flags);
  if (file >= 0 && is_wanted("termination_at_named_spill")) {
    raise(SIGTERM);
  }
  return file;
}

__attribute__((visibility("default"))) FILE* fopen(const char* name, const char* mode) {
  FILE* const file = next<FILE*(const char*, const char*)>("fopen")(name, mode);
  if (file != nullptr && mode[0] == 'w') {
    created();
  }
  return file;
}
}
