// Every system call of small jobs fails once, in every way that it can; memory and threads that the
// system refuses are system calls as well.
#include <sys/syscall.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include <gtest/gtest.h>

#include "tests/reliability/faults/program_job.hpp"
#include "tests/reliability/faults/traced_program.hpp"

namespace simdbezier::tests::system_calls_test {
namespace {

constexpr int kShortTransfer = -1; ///< instead of an error

/// System calls of one kind, and the errors that they may meet.
struct Trouble {
  const char* name;
  std::vector<long> calls;
  std::vector<int> errors;
};

const std::vector<Trouble>& troubles() {
  static const std::vector<Trouble> all = {
      {"write", {SYS_write, SYS_writev, SYS_pwrite64}, {ENOSPC, EIO, EPIPE, EINTR, kShortTransfer}},
      {"sync", {SYS_fsync, SYS_fdatasync, SYS_sync_file_range}, {EIO, ENOSPC, EINTR}},
      {"close", {SYS_close}, {EIO, EINTR, ENOSPC}},
      {"rename", {SYS_rename, SYS_renameat, SYS_renameat2}, {EIO, EACCES, ENOSPC, EINTR}},
      {"open", {SYS_open, SYS_openat, SYS_creat}, {EIO, EMFILE, EINTR, ENOSPC}},
      {"read", {SYS_read, SYS_readv, SYS_pread64}, {EIO, EINTR, kShortTransfer}},
      {"name",
       {SYS_stat, SYS_lstat, SYS_fstat, SYS_newfstatat, SYS_statx, SYS_access, SYS_faccessat,
        SYS_faccessat2, SYS_readlink, SYS_readlinkat, SYS_statfs, SYS_fstatfs},
       {EIO, ENOENT}},
      {"mode",
       {SYS_chmod, SYS_fchmod, SYS_fchmodat, SYS_chown, SYS_fchown, SYS_fchownat, SYS_ftruncate,
        SYS_fallocate},
       {EPERM, EIO}},
#ifndef __SANITIZE_ADDRESS__ // whose own memory it would be
      {"memory", {SYS_mmap, SYS_brk, SYS_mremap, SYS_madvise}, {ENOMEM}},
#endif
      {"thread", {SYS_clone, SYS_clone3, SYS_sched_getaffinity}, {EAGAIN}},
      {"handler", {SYS_rt_sigaction, SYS_rt_sigprocmask}, {EINVAL}}};
  return all;
}

class SystemCalls : public ::testing::TestWithParam<const Job*> {
protected:
  static constexpr long kMostPlaces = 8; ///< of one kind in the short form

  /// One kind of trouble at every place; the short form takes errors and scenes in turn.
  void try_all(const Trouble& trouble) {
    const long count = run_traced(fresh_.arguments(), fresh_.folder(), {trouble.calls}).calls;
    fresh_.reset();
    for (const long nth : places(count, kMostPlaces)) {
      for (const int error : trouble.errors) {
        for (Scene* const scene : {&fresh_, &replacing_}) {
          if (every_place() || turn_++ % (2 * trouble.errors.size() + 1) == 0) {
            try_one(*scene, trouble, nth, error);
          }
        }
      }
    }
  }

  void try_one(Scene& scene, const Trouble& trouble, long nth, int error) {
    SCOPED_TRACE(testing::Message()
                 << trouble.name << " number " << nth << ": "
                 << (error == kShortTransfer ? "short transfer" : std::strerror(error))
                 << (&scene == &replacing_ ? ", replacing" : ""));
    SystemCallFault fault{trouble.calls, nth};
    fault.short_transfer = error == kShortTransfer;
    fault.error = fault.short_transfer ? 0 : error;
    scene.expect_sound(run_traced(scene.arguments(), scene.folder(), fault));
    scene.reset();
    ++tried_;
  }

  Scene fresh_{*GetParam(), false};
  Scene replacing_{*GetParam(), GetParam()->out[0] == 'o'};
  std::size_t turn_ = 0;
  int tried_ = 0;
};

TEST_P(SystemCalls, FailOnce) {
  for (const Trouble& trouble : troubles()) {
    try_all(trouble);
  }
  EXPECT_GE(tried_, 8) << "hardly anything was made to fail"; // info makes some calls more
}

// Signals at random times rarely meet the moments between two system calls that matter.
TEST_P(SystemCalls, AreFollowedByASignal) {
  const std::vector<long> any;
  const long count = run_traced(fresh_.arguments(), fresh_.folder(), {any}).calls;
  fresh_.reset();
  for (const int signal : {SIGTERM, SIGQUIT, SIGALRM, SIGUSR1}) {
    for (const long nth : places(count, signal == SIGTERM ? 60 : 4)) {
      SCOPED_TRACE(testing::Message() << strsignal(signal) << " at " << nth << " of " << count);
      const auto outcome =
          run_traced(replacing_.arguments(), replacing_.folder(), {.nth = nth, .signal = signal});
      replacing_.expect_sound(outcome, signal);
      replacing_.reset();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Jobs, SystemCalls, ::testing::ValuesIn(job_pointers()),
                         [](const auto& each) { return std::string(each.param->name); });

} // namespace
} // namespace simdbezier::tests::system_calls_test
