// Runs of simdbezier-mpi, under every MPI that it was built for.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include <sys/wait.h>

#include "tests/program/process/program.hpp"

namespace simdbezier::tests {

/// What starts ranks, and the program that was built for it.
struct Launcher {
  const char* mpiexec;
  const char* program;
};
#ifdef SIMDBEZIER_MPI_PROGRAMS
inline constexpr Launcher kLaunchers[] = {SIMDBEZIER_MPI_PROGRAMS};
#else
inline constexpr Launcher kLaunchers[] = {{nullptr, nullptr}};
#endif

/// Each test runs under every MPI for which there is a program.
class MpiRanks : public ::testing::TestWithParam<std::size_t> {
protected:
  void SetUp() override {
    if (kLaunchers[GetParam()].program == nullptr) {
      GTEST_SKIP() << "simdbezier-mpi is not built";
    }
  }

  struct Answer {
    int exit_code;
    std::string out;
    std::string err;
  };
  // Runs so many ranks, which may be more than there are cores. before: for the shell.
  Answer run_ranks(int ranks, const std::string& words, int threads = 1,
                   const std::string& before = "") const {
    const Launcher& launcher = kLaunchers[GetParam()];
    const std::string command =
        before + "OMP_NUM_THREADS=" + std::to_string(threads) +
        " OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"
        " OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none"
        " OMPI_MCA_btl_vader_single_copy_mechanism=none TMPDIR=/tmp " +
        launcher.mpiexec + " -n " + std::to_string(ranks) + " " + launcher.program + " " + words +
        " > '" + folder_.path("out") + "' 2> '" + folder_.path("err") + "' < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder_.path("out")),
            read_file(folder_.path("err"))};
  }
  [[nodiscard]] bool has_leftovers() const {
    for (const std::string& name : folder_.names()) {
      if (name.find(".tmp") != std::string::npos) {
        return true;
      }
    }
    return false;
  }

  TemporaryFolder folder_;
};

} // namespace simdbezier::tests
